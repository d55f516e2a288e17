//! The published experiments: what section 9 of `docs/methods.md` expects to hold does hold, what it knows not to hold
//! is reported so, the tables stay what they are, and simulated records are the same everywhere.

#![expect(clippy::expect_used, reason = "a test that cannot read its own data may say so by ending")]

use std::sync::Arc;

use sha2::{Digest, Sha256};
use wildpoint::experiment::{CHOICES, Cell, EXPERIMENTS, Held, Reproduction, find, published};
use wildpoint::report::{Reproduced, reproduced_html, reproduction_text};
use wildpoint::track::{ColumnKind, LoadOptions, Source, Track, load};

fn reproduced(id: &str, runs: usize) -> Reproduction {
    find(id).and_then(|e| e.reproduce(None, Some(runs), &|| {})).expect("the experiment runs")
}

/// What an experiment says of the statements of its document, each by its id.
struct Verdicts {
    hold: &'static [&'static str],
    do_not: &'static [&'static str],
    untold: &'static [&'static str],
}

/// All statements have these verdicts, and there is no other statement.
fn assert_verdicts(result: &Reproduction, verdicts: &Verdicts) {
    let lists = [(verdicts.hold, Held::Yes), (verdicts.do_not, Held::No), (verdicts.untold, Held::CannotTell)];
    let wanted = |id: &str| lists.iter().find(|(ids, _)| ids.contains(&id)).map(|(_, held)| *held);
    let wrong: Vec<String> = result
        .findings
        .iter()
        .filter(|f| wanted(f.id) != Some(f.held))
        .map(|f| format!("{}: {}, not {:?}: {}", f.id, f.held.word(), wanted(f.id).map(Held::word), f.measured))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(result.findings.len(), lists.iter().map(|(ids, _)| ids.len()).sum::<usize>(), "statements");
}

/// The figure of the first row with these first cells, in a column (by its number).
fn figure(result: &Reproduction, row: &[&str], column: usize) -> f64 {
    let is_row = |cells: &&Vec<Cell>| row.iter().zip(*cells).all(|(name, cell)| cell.shown() == *name);
    match result.tables.iter().flat_map(|t| &t.rows).find(is_row).and_then(|cells| cells.get(column)) {
        Some(Cell::Number { value, .. }) => *value,
        other => panic!("{row:?}: {other:?}"),
    }
}

#[test]
fn jiang_two_directions_beat_one_and_variable_order_is_level_with_the_best() {
    let result = reproduced("jiang", 8);
    let verdicts = Verdicts {
        hold: &[
            "variable-level-with-best-fixed",
            "second-order-misses-more",
            "third-order-worst",
            "two-sided-beats-one-sided",
            "two-sided-fewer-false",
            "figures-of-the-variable-test",
            "some-cannot-be-removed",
            "single-and-patches",
            "losses-and-steps-do-no-harm",
            "residual-before-and-after",
        ],
        do_not: &["second-order-more-reliable", "a-looser-limit-misses-fewer", "three-deviations"],
        untold: &[],
    };
    assert_verdicts(&result, &verdicts);
    insta::assert_snapshot!(reproduction_text(&result));
}

#[test]
fn hou_offline_masks_grubbs_and_nobody_finds_more_than_one_who_knows_sigma() {
    let result = reproduced("hou-offline", 60);
    let verdicts = Verdicts {
        hold: &[
            "wright-isolated",
            "wright-patches",
            "chauvenet-patches",
            "romanovsky-good",
            "odd-even-good",
            "odd-even-false",
            "diff-median-some",
            "diff-median-unstable",
        ],
        do_not: &[
            "isolated-effectively",
            "grubbs-best",
            "grubbs-best-on-patches",
            "grubbs-varying",
            "odd-even-for-patches",
        ],
        untold: &["chauvenet-cheap", "romanovsky-slow"],
    };
    assert_verdicts(&result, &verdicts);
    // Section 9: 14 % by Grubbs one at a time, one-sided (an implementation apart gives 14.1 over 3000 runs, 9 two-sided);
    // 85 % by Romanovsky, 84 % by an observer who knows sigma.
    for (method, rate, within) in [("grubbs", 14.0, 4.0), ("romanovsky", 85.0, 2.0), ("known sigma", 84.0, 1.5)] {
        let measured = figure(&result, &[method], 1);
        assert!((measured - rate).abs() <= within, "{method}: {measured}");
    }
    insta::assert_snapshot!(reproduction_text(&result));
}

#[test]
fn hou_realtime_has_the_order_of_the_document_without_a_rule_that_ends_a_run() {
    let result = reproduced("hou-realtime", 60);
    let verdicts = Verdicts {
        hold: &[
            "five-point-beats-alpha-beta-gamma",
            "adaptive-finds-more",
            "matched-fewest-false",
            "all-find-isolated",
            "adaptive-best-when-mixed",
        ],
        do_not: &[
            "adaptive-fewer-false",
            "matched-second",
            "adaptive-best-on-patches",
            "alpha-beta-gamma-best-on-varying",
        ],
        untold: &["cost"],
    };
    assert_verdicts(&result, &verdicts);
    // Section 9, found of 24: by our rules, and without a rule that ends a run 84.7, 84.4, 87.1 (at 3 scales) and 83.1 %.
    for (method, found, within) in [
        ("alpha-beta-gamma (ours)", 18.0, 0.6),
        ("matched (ours)", 20.0, 0.3),
        ("adaptive (ours)", 10.3, 1.5),
        ("five-point", 0.847 * 24.0, 0.8),
        ("alpha-beta-gamma", 0.844 * 24.0, 0.8),
        ("adaptive (k 3)", 0.871 * 24.0, 0.8),
        ("matched", 0.831 * 24.0, 0.3),
    ] {
        let measured = figure(&result, &[method], 5);
        assert!((measured - found).abs() <= within, "{method}: {measured}");
    }
    insta::assert_snapshot!(reproduction_text(&result));
}

#[test]
fn jin_finds_with_a_trend_what_three_sigma_alone_leaves() {
    let result = reproduced("jin", 20);
    let verdicts = Verdicts {
        hold: &["wright-misses", "trend-finds-what-wright-leaves", "two-or-three-passes"],
        do_not: &["wright-cuts-the-tail"],
        untold: &["velocities-need-no-trend"],
    };
    assert_verdicts(&result, &verdicts);
    // sqrt(5) is below 3: not a single good sample of the tail.
    assert!(figure(&result, &["wright"], 6) < 0.05);
    insta::assert_snapshot!(reproduction_text(&result));
}

/// On the simulated record a trend of 4,250 m hides 60 m from three deviations, and three deviations of a parabola cut off
/// none of its data (sqrt(5) = 2.236 at its end). On the real one the seasons of 19 years hide the wild points from a
/// parabola too.
#[test]
fn jin_gps_finds_with_a_trend_what_hides_in_it_unless_the_seasons_hide_it() {
    let result = reproduced("jin-gps", 1);
    let is_real = result.tables.iter().any(|table| table.title.contains("gnss_daily_kmin"));
    let verdicts = if is_real {
        Verdicts {
            hold: &["wright-removes-hardly-any"],
            do_not: &["wright-loses-data", "trend-and-wright-very-good"],
            untold: &[],
        }
    } else {
        Verdicts {
            hold: &["wright-removes-hardly-any", "trend-and-wright-very-good"],
            do_not: &["wright-loses-data"],
            untold: &[],
        }
    };
    assert_verdicts(&result, &verdicts);
}

#[test]
fn qin_has_the_median_best_and_the_template_worst_at_fifty() {
    let result = reproduced("qin", 6);
    let verdicts = Verdicts {
        hold: &[
            "median-and-mean-best-at-50",
            "median-best-at-50",
            "template-worst-at-50",
            "median-and-poly-best-at-200",
            "median-smallest-at-50",
            "median-good-on-both",
            "template-poor-on-isolated",
            "template-leaves-isolated-at-50",
            "poly-poor-on-patches",
            "mean-poor-on-isolated-at-200",
        ],
        do_not: &[
            "median-and-mean-best-at-20",
            "template-inaccurate-at-20",
            "mean-breaks-at-200",
            "template-grows",
            "template-worst-then-mean",
            "mean-and-median-best-at-10",
            "median-small-throughout",
            "mean-steadiest-at-20",
            "median-and-mean-on-both-at-20",
            "eq-1-as-printed",
        ],
        untold: &[],
    };
    assert_verdicts(&result, &verdicts);
    for window in ["7", "8", "10"] {
        for method in ["poly-window", "template", "mean-window", "median-window"] {
            // Such windows cannot reach three scales: `docs/methods.md`, section 3.
            assert!(figure(&result, &[window, method], 4) < 0.5, "{method} with a window of {window}");
        }
    }
    insta::assert_snapshot!(reproduction_text(&result));
}

#[test]
fn gan_removes_both_and_deals_with_the_single_one_as_the_usual_filter() {
    let result = reproduced("gan", 60);
    let verdicts = Verdicts {
        hold: &["both-removed", "single-as-by-the-usual-filter", "good-samples-pass", "outliers-are-found"],
        do_not: &["spline-better-than-prediction", "infill-keeps-the-filter"],
        untold: &[],
    };
    assert_verdicts(&result, &verdicts);
    insta::assert_snapshot!(reproduction_text(&result));
}

/// Figure 3 of \[004\] is the track behind the filter: over the patch of 150 m it lies within a few times the noise of 5 m
/// from the record without outliers. The figures before it show none.
#[test]
fn the_page_of_the_filter_draws_the_filtered_track() {
    let gan = find("gan").expect("the experiment");
    let shown = gan.pictures(gan.seed).expect("its pictures");
    assert_eq!(shown.iter().map(|s| s.filtered.is_some()).collect::<Vec<_>>(), [false, true, true]);
    let clean = (gan.record)(gan.seed).signals[0].clean.clone().expect("it knows its outlier-free values");
    for filtered in shown.iter().filter_map(|s| s.filtered.as_ref()) {
        let off = (110..118).map(|i| (filtered.value[i] - clean[i]).abs()).fold(0.0, f64::max);
        assert!(off < 50.0, "{off}");
    }
    let page = reproduced_html(&[Reproduced { result: reproduced("gan", 1), shown }]);
    assert_eq!(page.matches(r#"<path class="filtered""#).count(), 2, "one in each trace");
    assert!(page.contains("filtered track</span>") && page.contains("CN 113326878"));
}

fn loaded(text: String) -> Track {
    let source = Source::BuiltIn { name: "wildpoint:test", bytes: Arc::from(text.into_bytes()) };
    load(&source, &LoadOptions::default()).expect("a simulated record can be loaded")
}

#[test]
fn the_loader_takes_a_simulated_record_for_what_it_is() {
    for experiment in EXPERIMENTS {
        let record = (experiment.record)(experiment.seed);
        let track = loaded(experiment.csv(experiment.seed, 1));
        assert_eq!(track.time.column, Some(0), "{}", experiment.id);
        assert_eq!(track.columns.last().map(|c| c.kind), Some(ColumnKind::Truth), "{}", experiment.id);
        let wild: Vec<bool> = record.wild.iter().map(Option::is_some).collect();
        assert_eq!(track.truth.as_deref(), Some(&wild[..]), "{}", experiment.id);
        for signal in &record.signals {
            let of = |name: &str| track.channel(name).map(|c| c.values.clone());
            assert_eq!(of(signal.name).as_ref(), Some(&signal.values), "{} {}", experiment.id, signal.name);
            assert_eq!(of(&signal.clean_name()), signal.clean, "{} {}", experiment.id, signal.name);
        }
    }
}

#[test]
fn truth_marks_what_differs_from_the_outlier_free_column() {
    for experiment in published() {
        let record = (experiment.record)(7);
        let signal = &record.signals[0];
        let clean = signal.clean.as_ref().expect("experiments know their outlier-free values");
        for (i, (y, clean)) in signal.values.iter().zip(clean).enumerate() {
            assert_eq!(record.wild[i].is_some(), y != clean, "{} sample {i}", experiment.id);
        }
    }
}

#[test]
fn several_runs_are_cut_apart_and_are_those_of_the_following_seeds() {
    let jin = find("jin").expect("jin");
    let text = jin.csv(5, 3);
    let second = jin.csv(6, 1);
    let value = |line: &str| line.split(',').nth(1).map(str::to_owned);
    let of_second: Vec<_> = second.lines().skip(1).map(value).collect();
    let all: Vec<_> = text.lines().skip(1).map(value).collect();
    assert_eq!(all[1000..2000], of_second);
    let track = loaded(text);
    assert_eq!(track.columns.last().map(|c| (c.name.as_str(), c.kind)), Some(("run", ColumnKind::Text)));
    let series = track.channels[0].series(&track.time);
    assert_eq!(series.segments(Some(5)), [0..1000, 1000..2000, 2000..3000]);
}

/// Sums of the bytes that the first seed gives. A change of a sum means that everybody's simulated records change; a
/// difference between machines means that some rounding was left to the platform.
#[test]
fn simulated_records_have_the_same_bytes_everywhere() {
    let sum = |text: String| Sha256::digest(text).iter().take(8).map(|b| format!("{b:02x}")).collect::<String>();
    let sums: Vec<String> =
        published().map(|e| format!("{} {} {}", e.id, sum(e.csv(e.seed, 1)), sum(e.csv(1, 2)))).collect();
    insta::assert_snapshot!(sums.join("\n"));
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    let json = |r: Reproduction| serde_json::to_string(&r).expect("json");
    let alone = one.install(|| json(reproduced("hou-realtime", 8)));
    assert_eq!(alone, json(reproduced("hou-realtime", 8)));
}

/// The figures of the table of advice are those of the experiments, to what fewer runs than theirs can tell: with 60 of
/// 200 runs a rate is known to about 4 of 100, with 6 a count to a tenth.
#[test]
fn the_table_of_advice_has_the_figures_of_the_experiments() {
    for (id, runs) in [("hou-offline", 60), ("hou-realtime", 60), ("jin", 20), ("qin", 6), ("gan", 60), ("jiang", 8)] {
        let result = reproduced(id, runs);
        let of = CHOICES.iter().flat_map(|choice| choice.measured).filter(|m| m.experiment == id);
        for measured in of {
            let now = figure(&result, measured.row, measured.column);
            let within = 0.1 * measured.value + 4.0;
            assert!((now - measured.value).abs() <= within, "{id} {:?}: {now}, not {}", measured.row, measured.value);
        }
    }
}
