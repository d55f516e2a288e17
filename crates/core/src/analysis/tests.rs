use super::*;
use crate::check::Applied;
use crate::setup::Preset;

/// A wavy channel of 400 samples with a fill value at every 20th.
fn filled() -> (Vec<f64>, Vec<f64>) {
    let t: Vec<f64> = (0..400).map(f64::from).collect();
    let y = (0..400)
        .map(|i| if i % 20 == 7 { -9999.0 } else { (0.05 * f64::from(i)).sin() + f64::from(i * i % 13) * 0.01 });
    (t, y.collect())
}

fn standard(checks: &[&str]) -> Setup {
    let mut setup = Setup::standard();
    setup.settings.set_text("two-sided", "floor", "record").unwrap();
    checks.iter().for_each(|text| setup.preparation.add(Applied::parse(text).unwrap()));
    setup
}

#[test]
fn a_channel_is_calibrated_on_what_its_method_sees() {
    let (t, y) = filled();
    let series = Series::new(&t, &y);
    let (all, checked) = (standard(&[]), standard(&["missing-values:values=-9999"]));
    let before = Detection::of(Input::from(&series), &all, &Stop::never()).unwrap();
    let alone = Detection::of(Input::from(&series), &checked, &Stop::never()).unwrap();
    let limits = |detection: &Detection| detection.calibration.as_ref().unwrap().limits.len();
    assert_eq!((limits(&before), limits(&alone)), (400, 380));
    // The calibration of other samples is not taken over.
    let after = Detection::calibrated(Input::from(&series), &checked, Some(&before), &Stop::never()).unwrap();
    assert_eq!(after.calibration, alone.calibration);
    assert_eq!(after.judged.verdict(), alone.judged.verdict());
    assert_eq!(after.scales, alone.scales);
}

#[test]
fn a_channel_is_calibrated_once_while_its_method_sees_the_same_samples() {
    let (t, y) = filled();
    let series = Series::new(&t, &y);
    let mut setup = standard(&["missing-values:values=-9999"]);
    let before = Detection::of(Input::from(&series), &setup, &Stop::never()).unwrap();
    setup.settings.set_text("two-sided", "k", "6").unwrap();
    let after = Detection::calibrated(Input::from(&series), &setup, Some(&before), &Stop::never()).unwrap();
    assert!(Arc::ptr_eq(before.calibration.as_ref().unwrap(), after.calibration.as_ref().unwrap()));
}

#[test]
fn a_channel_of_which_nothing_is_left_is_calibrated_to_nothing() {
    let (t, y) = ([0.0, 1.0, 2.0], [-9999.0; 3]);
    let series = Series::new(&t, &y);
    let setup = standard(&["missing-values:values=-9999"]);
    let detection = Detection::of(Input::from(&series), &setup, &Stop::never()).unwrap();
    assert!(detection.judged.verdict().iter().all(|v| *v == Verdict::Outlier));
    assert_eq!(detection.calibration.unwrap().typical_limit(), None);
}

/// [004] figure 3: the track after the filter. What a run of wild points leaves of it is within the noise.
#[test]
fn the_filtered_track_goes_on_under_a_run_and_follows_the_analyst() {
    let t: Vec<f64> = (0..200).map(f64::from).collect();
    let truth: Vec<f64> = t.iter().map(|t| 0.05 * t * t + 3.0 * t).collect();
    let mut y: Vec<f64> = truth.iter().zip(0..).map(|(v, i)| v + if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
    y[90..96].iter_mut().for_each(|y| *y += 60.0);
    y[150] += 60.0;
    let mut setup = Setup::new(crate::method::find("kalman").unwrap(), Preset::Default);
    setup.set_text("sigma", "1").unwrap();
    setup.set_text("floor", "auto").unwrap();
    let series = Series::new(&t, &y);
    let of = |decisions: &Decisions| {
        let detection = Detection::of((&series).into(), &setup, &Stop::never()).unwrap();
        let rows = Rows { seconds: &t, own: None };
        let outcome = settle(&series, rows, detection.into(), decisions, &Stop::never()).unwrap();
        filtered(&outcome, &series, &Stop::never()).unwrap().unwrap()
    };
    let track = of(&Decisions::default());
    assert!(track.value.iter().zip(&truth).all(|(v, truth)| (v - truth).abs() < 3.0), "{:?}", track.value);
    assert!(track.deviation.iter().all(|d| *d > 0.0 && *d < 1.5), "{:?}", track.deviation);
    let mut kept = Decisions::default();
    kept.set(150, Some(Decision { ruling: crate::review::Ruling::Normal, note: String::new(), said: None }));
    assert!(of(&kept).value[150] - truth[150] > 10.0, "what the analyst keeps enters the filter");
}
