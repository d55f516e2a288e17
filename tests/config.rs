//! The configuration as a user has it: a file in the usual folder, or one that is named.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod program;

use program::Folder;

/// A folder whose configuration (`$XDG_CONFIG_HOME` is the folder itself) is this.
fn configured(text: &str) -> Folder {
    let folder = Folder::with_demo();
    std::fs::create_dir(folder.path("wildpoint")).unwrap();
    std::fs::write(folder.path("wildpoint/config.toml"), text).unwrap();
    folder
}

#[test]
fn the_keys_in_force_are_printed_as_a_configuration_that_gives_them() {
    let folder = configured("[keys]\nnext-flag = [\"f5\", \"g z\"]\n");
    let printed = folder.done("keys");
    assert!(printed.contains("\nnext-flag = [\"f5\", \"g z\"]") && printed.contains("[keys.queue]"), "{printed}");
    std::fs::write(folder.path("other.toml"), &printed).unwrap();
    assert_eq!(folder.done("keys --config other.toml"), printed);
    let plain = folder.done("keys --no-config");
    assert!(plain.contains("\nnext-flag = [\"n\"]"), "{plain}");
}

#[test]
fn a_configuration_that_is_not_understood_ends_the_start_with_the_line() {
    let text = "# mine\n[keys]\nnext-flag = \"n\"\naccept = \"n\"\n";
    let folder = configured(text);
    for words in ["demo.csv", "keys"] {
        let ran = folder.run(words);
        assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{words}");
        let place = "wildpoint/config.toml:4: n means next-flag and accept";
        assert!(ran.err.contains(place) && ran.err.contains("--no-config starts without it"), "{}", ran.err);
    }
    // It is read and never written.
    assert_eq!(
        (folder.names(), folder.text("wildpoint/config.toml")),
        (vec!["demo.csv".into(), "wildpoint".into()], text.into())
    );
    assert_eq!(folder.run("--no-config demo.csv").status, 0);
    // What needs no screen does not look at it.
    folder.done("methods hampel");
}

#[test]
fn a_named_configuration_must_be_there_and_an_unnamed_one_need_not() {
    let folder = Folder::with_demo();
    folder.done("keys");
    let ran = folder.run("keys --config nope.toml");
    assert!(ran.status == 2 && ran.err.contains("nope.toml: cannot read"), "{}", ran.err);
    let both = folder.run("keys --config nope.toml --no-config");
    assert!(both.status == 2 && both.err.contains("cannot be used with"), "{}", both.err);
}

#[test]
fn hostile_text_in_a_configuration_is_made_visible() {
    let folder = configured("[keys]\n\"\\u001b[31mred\" = \"n\"\n");
    let ran = folder.run("keys");
    assert!(ran.status == 2 && ran.err.contains("\\x1b[31mred") && !ran.err.contains('\x1b'), "{:?}", ran.err);
    for text in
        ["[keys\n", "\u{0}", "[[keys]]\n", "keys = 5", "[keys]\nnext-flag = [[\"n\"]]\n", "[screen]\nfps = 1e999"]
    {
        let ran = configured(text).run("keys");
        assert!(ran.status == 2 && ran.err.contains("config.toml:"), "{text:?}: {}", ran.err);
    }
}

#[test]
fn the_configuration_of_the_manual_is_understood() {
    let page = include_str!("../docs/reference/configuration.md");
    let blocks: Vec<&str> = page.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    let folder = configured(blocks.iter().find(|block| block.contains("[screen]")).unwrap());
    assert!(folder.done("keys").contains("\nnext-flag = [\"n\", \"f5\"]"));
}
