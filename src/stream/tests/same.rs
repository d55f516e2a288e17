//! The last word of a stream about each sample is that of the method over the whole record.

use super::*;

/// A record with its own times, in order.
struct Record {
    name: String,
    t: Vec<f64>,
    y: Vec<f64>,
}

/// Noise on an arc, with spikes, patches longer and shorter than any `max_run`, a step, gaps and lost samples.
fn made(seed: u64) -> Record {
    let mut random = Random::new(seed);
    let (mut t, mut y) = (Vec::new(), Vec::new());
    let mut wild = 0;
    for i in 0..1500 {
        let time = f64::from(i) * 0.1;
        if i % 97 == 0 {
            wild = (i / 97) * 2 % 31;
        }
        if i % 211 < 2 || (900..940).contains(&i) {
            continue;
        }
        let mut value = 200.0 + 3.0 * time - 0.02 * time * time + random.normal() + if i > 600 { 80.0 } else { 0.0 };
        if wild > 0 {
            wild -= 1;
            value += 40.0 + f64::from(i % 3);
        }
        t.push(time);
        y.push(value);
    }
    Record { name: format!("made {seed}"), t, y }
}

fn vectors() -> Vec<Record> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/vectors");
    let names = ["arc_spikes", "gaps", "jitter_missing", "quantised", "sine_patches", "step"];
    let read = |name: &str| {
        let mut reader = csv::Reader::from_path(folder.join(format!("{name}.csv"))).unwrap();
        let rows: Vec<csv::StringRecord> = reader.records().map(|r| r.unwrap()).collect();
        let column = |c: usize| rows.iter().map(|r| r[c].parse().unwrap_or(f64::NAN)).collect();
        Record { name: name.to_owned(), t: column(0), y: column(1) }
    };
    names.into_iter().map(read).collect()
}

/// The settings with what a stream cannot do taken out of them, for the run over the whole record.
fn settings(id: &str, paper: bool, sigma: f64) -> Settings {
    let params = method::find(id).unwrap().about().params;
    let mut settings = if paper { Settings::paper(params) } else { Settings::defaults(params) };
    // No run is so long that `patch` of 1000 would have it filled.
    for (key, text) in [
        ("look_back", "false"),
        ("noise_floor", "off"),
        ("direction", "forward"),
        ("floor", "0"),
        ("patch", "1000"),
        ("sigma", sigma.to_string().as_str()),
    ] {
        if settings.get(key).is_some() {
            settings.set_text(id, key, text).unwrap();
        }
    }
    settings
}

fn streamed_verdicts(plan: &Plan, series: &Series<'_>) -> (Vec<Said>, usize, usize) {
    let mut judge = Judge::new(plan.clone(), series.interval);
    let mut last = Vec::new();
    let (mut lost, mut corrected) = (0, 0);
    for (at, (t, y)) in series.t.iter().zip(series.y.iter()).enumerate() {
        let heard = judge.push(*t, *y, at);
        last.push(heard.said);
        for (at, before, now) in heard.corrections {
            assert_eq!(last[at], before, "what is corrected is what was said");
            last[at] = now;
            corrected += 1;
        }
        lost += heard.lost.len();
    }
    (last, lost, corrected)
}

fn near(a: f64, b: f64, largest: f64) -> bool {
    (a.is_nan() && b.is_nan()) || (a - b).abs() <= 1e-9 * largest
}

fn compare(record: &Record, id: &str, paper: bool) -> (usize, usize) {
    let series = Series::new(&record.t, &record.y);
    let whole = 0..series.len();
    let sigma = noise::by_difference(&series, std::slice::from_ref(&whole), &Stop::never()).unwrap()[0].max(0.5);
    let settings = settings(id, paper, sigma);
    let method = method::find(id).unwrap();
    let over: Judged = judge_channel(method, &series, None, &settings, &Stop::never()).unwrap();
    let (last, lost, corrected) = streamed_verdicts(&Plan { method, settings }, &series);
    let largest = series.y.iter().fold(1.0_f64, |m, y| m.max(y.abs()));
    for (at, said) in last.iter().enumerate() {
        let place = format!("{id} {} {} sample {at}", record.name, if paper { "paper" } else { "default" });
        assert_eq!(said.verdict, over.verdict[at], "{place}");
        assert!(near(said.expected, over.expected[at], largest), "{place}: {said:?} {}", over.expected[at]);
        let tolerance = over.tolerance[at];
        assert!(near(said.tolerance, tolerance, largest), "{place}: {said:?} {tolerance}");
    }
    assert_eq!(lost, over.restarts.len(), "{id} {}", record.name);
    (lost, corrected)
}

#[test]
fn the_last_word_is_that_of_the_whole_record() {
    let mut records = vec![made(1), made(2)];
    records.extend(vectors());
    let mut most_lost = 0;
    for record in &records {
        for id in predict::METHODS {
            for paper in [false, true] {
                let (lost, corrected) = compare(record, id, paper);
                most_lost = most_lost.max(lost);
                assert!(id != "template" || corrected == 0, "the template takes nothing back");
            }
        }
    }
    assert!(most_lost > 3, "the records must make models restart: {most_lost}");
}

#[test]
fn it_keeps_no_more_than_it_can_speak_of() {
    for (id, most) in [("five-point", 16), ("two-sided", 16), ("kalman", 26)] {
        let plan = Plan { method: method::find(id).unwrap(), settings: settings(id, false, 1.0) };
        let mut judge = Judge::new(plan, 1.0);
        let mut random = Random::new(3);
        for i in 0..20_000 {
            judge.push(f64::from(i), random.normal(), ());
        }
        assert_eq!(judge.kept(), most, "{id}");
    }
}
