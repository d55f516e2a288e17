//! What of a record is shown first, and what is said of it then.

use wildpoint_core::analysis::Input;

use super::action::Action;
use super::files;
use super::model::Model;
use crate::session::{Detection, Plan, Session, suggestions};
use crate::stop::Stop;
use crate::track::{Series, Track, is_id, is_spread, printable};

/// Samples that are looked at for the plan that is shown first, of all channels together.
const LOOKED_AT: usize = 100_000;

/// The plan that is shown first: that of the channel in which the most samples stand clear of the noise, among the first
/// samples of each; without any, of the first channel that is not, by its name, an id. What tells how well another channel
/// is known comes after those.
pub(super) fn plan(session: &Session, track: &Track) -> usize {
    let measured = |plan: &&Plan| !is_spread(&plan.channel);
    let any = session.plans.iter().any(|plan| measured(&plan) && !is_id(&plan.channel));
    let is_shown = |plan: &Plan| !is_id(&plan.channel) && (!any || measured(&plan));
    let first = session.plans.iter().position(is_shown).unwrap_or(0);
    let most = LOOKED_AT / session.plans.len().max(1);
    let clear = |plan: &Plan| clear(plan, track, most).unwrap_or(0);
    let counted = session.plans.iter().enumerate().filter(|(_, plan)| !any || measured(plan));
    let counts = counted.map(|(index, plan)| (index, clear(plan))).filter(|(_, clear)| *clear > 0);
    // Of equals the first.
    counts.rev().max_by_key(|(_, clear)| *clear).map_or(first, |(index, _)| index)
}

/// How many of the first samples of a channel stand clear of the noise; none where its floor is not from the record.
fn clear(plan: &Plan, track: &Track, most: usize) -> Option<usize> {
    let channel = track.channel(&plan.channel)?;
    let series = channel.series(&track.time);
    let n = series.len().min(most);
    let head = Series::new(series.t.get(..n)?, series.y.get(..n)?);
    let detection = Detection::of(Input::new(&head, None), &plan.setup, &Stop::never()).ok()?;
    Some(detection.calibration?.clear())
}

/// What a user should know before trusting the record: the loader's notes or, without any, what it could not use.
/// Samples that are left out change results as much as samples that are flagged.
pub(super) fn notes(track: &Track) -> Vec<String> {
    if !track.notes.is_empty() {
        return track.notes.clone();
    }
    let mut notes = files::faults(track);
    let out_of_order = track.faults.repeated_times.count + track.faults.backward_times.count > 0;
    let id = track.channels.iter().find(|channel| is_id(&channel.name));
    match id.filter(|_| out_of_order && track.track_column().is_none()) {
        Some(id) => {
            notes.push(format!("`{}` may tell several tracks apart: :loader, track column", printable(&id.name)));
        }
        None if !notes.is_empty() => notes.push(":loader shows and corrects how the record is read".into()),
        None => {}
    }
    notes
}

/// What is done with the channel on the screen before its method sees it because the record suggests it, and what the
/// record suggests beside.
pub(super) fn prepared(model: &Model) -> Vec<String> {
    let done = &model.plan().setup.preparation;
    if model.file.is_some() {
        return Vec::new();
    }
    let suggested = suggestions(model.channel());
    let (done, offered): (Vec<_>, Vec<_>) = suggested.into_iter().partition(|s| done.has(&s.remedy));
    let mut words: Vec<String> = done.into_iter().map(|s| s.words).collect();
    if !offered.is_empty() {
        let list: Vec<String> = offered.into_iter().map(|s| s.words).collect();
        words.push(format!("{}: {} takes it", list.join("; "), model.key(Action::SuggestedChecks)));
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::Setup;
    use crate::track::{LoadOptions, Source, load};

    fn loaded(text: &'static str, options: &LoadOptions) -> (Track, Session) {
        let track = load(&Source::BuiltIn { name: "test", bytes: text.as_bytes().into() }, options).unwrap();
        let session = Session::new(&track, options.clone(), &Setup::standard());
        (track, session)
    }

    #[test]
    fn an_id_is_not_what_one_looks_at_and_is_named_where_times_are_out_of_order() {
        // Two beacons answer in turn, and one of them late.
        let text = "t_s,beacon,range_m\n0,1,5.0\n1,2,7.0\n2,1,5.1\n1.5,2,7.1\n4,1,5.2\n5,2,7.2\n6,1,5.3\n7,2,7.3\n8,1,5\n9,2,7\n10,1,5\n";
        // By the first rules tracks are told, not recognised.
        let first = LoadOptions { rules: crate::track::Rules::First, ..LoadOptions::default() };
        let (track, session) = loaded(text, &first);
        assert_eq!(session.plans[plan(&session, &track)].channel, "range_m");
        assert_eq!(
            notes(&track),
            ["1 time that goes back (line 5: 1.5)", "`beacon` may tell several tracks apart: :loader, track column",]
        );
        let told = LoadOptions { track: Some("beacon".into()), ..LoadOptions::default() };
        assert_eq!(notes(&loaded(text, &told).0).last().map(String::as_str), None, "each is in order by itself");
    }

    #[test]
    fn what_could_not_be_read_is_said_and_a_record_without_faults_is_met_in_silence() {
        let (track, session) = loaded("t_s,id\n0,1\n1,2\n2,x\n3,4\n", &LoadOptions::default());
        assert_eq!(plan(&session, &track), 0, "there is nothing else");
        let said = notes(&track);
        assert!(said[0].starts_with("1 unreadable cell ") && said[1].contains(":loader"), "{said:?}");
        assert!(notes(&loaded("t_s,x\n0,1\n1,2\n2,3\n", &LoadOptions::default()).0).is_empty());
    }

    #[test]
    fn what_tells_how_well_another_channel_is_known_is_not_shown_first() {
        let row =
            |i: usize| format!("{i},{}.{},0.0{}\n", 3 + i % 5, i * 7 % 10, if i == 40 { 999 } else { 10 + i % 3 });
        let text: String = (0..80).map(row).collect();
        let text: &'static str = Box::leak(format!("t_s,east_m,sig_e\n{text}").into_boxed_str());
        let (track, session) = loaded(text, &LoadOptions::default());
        assert_eq!(session.plans[plan(&session, &track)].channel, "east_m");
    }

    #[test]
    fn the_channel_whose_wild_points_stand_clearest_is_shown_first() {
        let mut text = String::from("t_s,speed,height\n");
        for i in 0..300 {
            let height = if i == 150 { 9000 } else { 1000 + i * 7919 % 11 };
            text += &format!("{i},{},{height}\n", 50 + i * 104_729 % 7);
        }
        let (track, session) = loaded(Box::leak(text.into_boxed_str()), &LoadOptions::default());
        assert_eq!(session.plans[plan(&session, &track)].channel, "height");
    }
}
