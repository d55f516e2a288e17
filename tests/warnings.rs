//! Which settings a method warns of: those with which it cannot flag, or does what nobody wants, and no others.

#![expect(clippy::expect_used, reason = "a test that cannot set itself up should fail")]

use wildpoint::method::find;
use wildpoint::param::Settings;

/// What `id` says of its defaults with `changes`, its lines joined.
fn said(id: &str, changes: &[(&str, &str)]) -> String {
    let method = find(id).expect("a registered method");
    let mut settings = Settings::defaults(method.about().params);
    changes.iter().for_each(|(key, text)| settings.set_text(id, key, text).expect("a legal value"));
    method.warnings(&settings).join("\n")
}

#[test]
fn defaults_are_nothing_to_warn_of() {
    for method in wildpoint::method::METHODS {
        assert_eq!(said(method.about().id, &[]), "", "{}", method.about().id);
    }
}

/// Section 3, "Bounds": with `rms` and k = 3 the windows need 11 samples, the parabola 12.
#[test]
fn a_window_too_short_for_its_scale_cannot_flag() {
    for id in ["mean-window", "median-window", "hampel", "template"] {
        let rms = |window| said(id, &[("scale", "rms"), ("k", "3"), ("window", window)]);
        assert!(rms("10").starts_with("cannot flag anything") && !rms("10").contains('\n'), "{id}: {}", rms("10"));
        assert_eq!(rms("11"), "", "{id}");
        assert_eq!(said(id, &[("scale", "mad"), ("k", "3"), ("window", "10")]), "", "{id}");
    }
    let poly = |window| said("poly-window", &[("k", "3"), ("window", window)]);
    assert!(poly("11").starts_with("cannot flag anything"), "{}", poly("11"));
    assert_eq!(poly("12"), "");
}

/// Section 2, "Warnings": with a mean only, (n - 1) / sqrt(n) is below 3 for n < 11.
#[test]
fn a_block_too_short_for_three_sigma_cannot_flag() {
    for id in ["wright", "trend-wright"] {
        let block = |n| said(id, &[("trend_order", "0"), ("k", "3"), ("block", n)]);
        assert!(block("10").starts_with("cannot flag anything"), "{id}: {}", block("10"));
        assert_eq!(block("11"), "", "{id}");
    }
    // With a parabola no spike reaches more than 2.88 among 11 (section 3). At an end it has the leverage
    // 3(3n^2 - 3n + 2) / (n(n + 1)(n + 2)), 0.465 for n = 15: 2.74 scales; 3.46 for n = 20.
    let parabola = |n| said("trend-wright", &[("trend_order", "2"), ("k", "3"), ("block", n)]);
    assert!(parabola("11").starts_with("cannot flag anything"), "{}", parabola("11"));
    assert!(parabola("15").contains("at an end"), "{}", parabola("15"));
    assert_eq!(parabola("20"), "");
    // Four groups of odd-even are a quarter as long as the block: 10 and 25, and sqrt(9) < 3 < sqrt(24).
    let groups = |n| said("odd-even", &[("m", "2"), ("k", "3"), ("block", n)]);
    assert!(groups("40").starts_with("cannot flag anything"), "{}", groups("40"));
    assert_eq!(groups("100"), "");
}

/// The end of a parabola through 8 samples has the leverage 0.708: a spike there reaches sqrt(7 * 0.292) = 1.43 scales.
/// Chauvenet asks for 1.86 among 8, Grubbs at 0.01 for 2.27, Rosner at 0.05 for 2.13, Romanovsky at 0.01 for 1.98.
#[test]
fn a_block_too_short_for_a_test_cannot_flag_at_its_ends() {
    for id in ["chauvenet", "grubbs", "gesd", "romanovsky"] {
        assert!(said(id, &[("block", "8")]).contains("at an end"), "{id}: {}", said(id, &[("block", "8")]));
        assert_eq!(said(id, &[("block", "100")]), "", "{id}");
    }
}

#[test]
fn predictors_warn_of_runs_that_are_taken_for_changes_and_of_first_samples() {
    for id in ["five-point", "alpha-beta-gamma", "adaptive"] {
        assert!(said(id, &[("max_run", "4")]).contains("a run of 5 or more outliers"), "{id}");
        assert_eq!(said(id, &[("max_run", "5")]), "", "{id}");
        assert_eq!(said(id, &[("max_run", "0")]), "", "{id}: 0 is never");
        assert!(said(id, &[("look_back", "false")]).contains("first five samples"), "{id}");
    }
    // Section 4: k = c gives the printed rule, with about 10 % false.
    for k in ["1.5", "1"] {
        assert!(said("adaptive", &[("k", k), ("huber_c", "1.5")]).contains("about one good sample in ten"), "{k}");
    }
    assert_eq!(said("adaptive", &[("k", "1.6"), ("huber_c", "1.5")]), "");
    assert!(said("matched", &[("window", "10")]).contains("runs of two or more"));
    assert_eq!(said("matched", &[("window", "11")]), "");
}

#[test]
fn the_filter_warns_of_a_gate_that_opens_and_of_first_samples() {
    // Section 7: 0.1 opens the gate in two or three samples, unless it is held.
    assert!(said("kalman", &[("gate_cap", "off"), ("tracking_index", "0.1")]).contains("the gate opens"));
    assert_eq!(said("kalman", &[("gate_cap", "off"), ("tracking_index", "0.09")]), "");
    assert_eq!(said("kalman", &[("tracking_index", "0.1")]), "");
    assert!(said("kalman", &[("look_back", "false")]).contains("first four samples"));
}

#[test]
fn the_two_sided_test_warns_of_noisy_candidates_and_of_half_a_rule() {
    // Four steps from two points: weights 5 and -4, sqrt(1 + 25 + 16) = 6.48 sigma.
    let two = [("two_point", "true"), ("k", "4")];
    assert!(said("two-sided", &two).contains("6.5 sigma"), "{}", said("two-sided", &two));
    assert_eq!(said("two-sided", &[("two_point", "true"), ("k", "6.5")]), "");
    assert_eq!(said("two-sided", &[("two_point", "true"), ("delta", "5")]), "", "a tolerance that is given");
    let one_way = [("repair_rule", "matched"), ("direction", "forward")];
    assert!(said("two-sided", &one_way).contains("needs both directions"));
    assert_eq!(said("two-sided", &one_way[..1]), "");
    assert_eq!(said("two-sided", &one_way[1..]), "");
}
