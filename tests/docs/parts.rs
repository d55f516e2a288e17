//! The generated parts of the pages, from the registries of the program.

use clap::{Arg, CommandFactory};
use wildpoint::check::CHECKS;
use wildpoint::cli::Cli;
use wildpoint::method::METHODS;
use wildpoint::param::Param;
use wildpoint::repair::{self, REPAIRS};
use wildpoint::report::DIAGNOSTIC_COLUMNS;
use wildpoint::session::flags::{BY_CHECKS, COLUMNS};
use wildpoint::session::table::Column;
use wildpoint::session::{CHANGED_COLUMNS, DECISION_COLUMNS, schemes_table};
use wildpoint::stream::STREAM_COLUMNS;
use wildpoint::track::{FORMATS, refused};
use wildpoint::tui::config::SETTINGS;
use wildpoint::tui::keys;
use wildpoint::tui::theme::ROLES;
use wildpoint::tui::update::{COMMANDS, FORMS};

/// A part: its marker, and what is between the markers.
pub(crate) type Part = (&'static str, String);

/// The parts of each page.
pub(crate) fn all() -> Vec<(&'static str, Vec<Part>)> {
    vec![
        ("what-it-reads.md", vec![("formats", formats()), ("refused", what_is_refused())]),
        ("reference/keys.md", vec![("keys", keys::markdown()), ("palette", palette()), ("jump", jumps())]),
        ("reference/commands.md", vec![("commands", commands())]),
        ("reference/configuration.md", vec![("theme", theme()), ("screen", screen())]),
        (
            "reference/methods.md",
            vec![("methods", methods()), ("repairs", repairs()), ("checks", checks()), ("parameters", parameters())],
        ),
        (
            "reference/tables.md",
            vec![
                ("flags-table", columns(COLUMNS.iter().chain(&BY_CHECKS))),
                ("changed-table", columns(&CHANGED_COLUMNS)),
                ("diagnostics-table", columns(&DIAGNOSTIC_COLUMNS)),
                ("decisions-table", columns(&DECISION_COLUMNS)),
                ("stream-table", columns(&STREAM_COLUMNS)),
                ("flags", schemes_table()),
            ],
        ),
        ("archive.md", RECIPES.iter().map(|(marker, file)| (*marker, recipe(file))).collect()),
        ("choosing.md", vec![("advice", advice())]),
        ("methods.md", vec![("choices", wildpoint::batch::choices_table())]),
    ]
}

/// The recipes of the page on archives: marker and file.
const RECIPES: [(&str, &str); 6] = [
    ("dask", "dask_archive.py"),
    ("spark", "spark_archive.py"),
    ("spark-kernel", "spark_kernel.py"),
    ("part", "archive_part.py"),
    ("slurm", "slurm_archive.sh"),
    ("parallel", "parallel_archive.sh"),
];

/// A file of `recipes/`, as a block of code.
fn recipe(file: &str) -> String {
    let language = if file.ends_with(".py") { "python" } else { "bash" };
    format!("```{language}\n{}```\n", super::read(&super::root().join("recipes").join(file)))
}

/// A table of two columns or more, as Markdown has it.
fn table(head: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let names: Vec<String> = head.iter().map(|h| (*h).to_owned()).collect();
    let ruler = format!("|{}\n", "---|".repeat(head.len()));
    // A pipe would part cells.
    rows.map(|row| line(&row.iter().map(|c| c.replace('|', "\\|")).collect::<Vec<_>>()))
        .fold(format!("{}{ruler}", line(&names)), |text, row| text + &row)
}

fn code(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("`{text}`") }
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn formats() -> String {
    let rows = FORMATS.iter().map(|f| vec![f.name.into(), f.about.into(), f.known_by.into(), f.maps.into()]);
    table(&["format", "what it is", "known by", "what is read"], rows)
}

fn what_is_refused() -> String {
    let mut rows: Vec<Vec<String>> = refused().map(|(name, help)| vec![name.into(), help.into()]).collect();
    rows.dedup();
    table(&["what", "what converts it"], rows.into_iter())
}

fn palette() -> String {
    let rows = COMMANDS.iter().map(|c| vec![code(c.name), code(c.takes), c.help.into()]);
    table(&["command", "takes", "what it does"], rows)
}

fn jumps() -> String {
    table(&["type", "to go to"], FORMS.iter().map(|(form, to)| vec![code(form), (*to).into()]))
}

fn theme() -> String {
    table(&["role", "paints"], ROLES.iter().map(|role| vec![code(role.name), role.about.into()]))
}

fn screen() -> String {
    let row =
        |s: &wildpoint::tui::config::Setting| vec![code(s.name), s.values.into(), s.default.into(), s.about.into()];
    table(&["key", "values", "default", "what it sets"], SETTINGS.iter().map(row))
}

fn methods() -> String {
    let rows = METHODS.iter().map(|m| m.about()).map(|a| {
        let params: Vec<String> = a.params.iter().map(|p| code(p.key)).collect();
        vec![code(a.id), a.name.into(), a.family.into(), a.source.into(), params.join(", ")]
    });
    table(&["id", "method", "family", "source", "parameters"], rows)
}

fn repairs() -> String {
    table(&["id", "an outlier becomes"], REPAIRS.iter().map(|r| vec![code(r.id), r.help.into()]))
}

fn checks() -> String {
    let rows = CHECKS.iter().map(|c| c.about()).map(|a| {
        let params: Vec<String> = a.params.iter().map(|p| code(p.key)).collect();
        vec![code(a.id), a.help.into(), params.join(", ")]
    });
    table(&["id", "flags", "parameters"], rows)
}

/// Every parameter once, with the methods whose default is another one.
fn parameters() -> String {
    let mut all: Vec<(&Param, Vec<&str>)> = Vec::new();
    for about in METHODS.iter().map(|m| m.about()) {
        for param in about.params {
            let same = |known: &Param| {
                (known.key, known.help, known.default, known.paper)
                    == (param.key, param.help, param.default, param.paper)
            };
            match all.iter_mut().find(|(known, _)| same(known)) {
                Some((_, of)) => of.push(about.id),
                None => all.push((param, vec![about.id])),
            }
        }
    }
    all.extend(repair::PARAMS.iter().map(|p| (p, vec!["repair"])));
    all.sort_by_key(|(param, _)| param.key);
    let row = |(p, of): (&Param, Vec<&str>)| {
        let paper = p.paper.map(|paper| paper.value.to_string()).unwrap_or_default();
        let of = if of.len() > 12 { "most".to_owned() } else { of.join(", ") };
        vec![code(p.key), p.default.to_string(), paper, p.unit.into(), p.range(), one_line(p.help), of]
    };
    table(&["key", "default", "paper", "unit", "values", "meaning", "of"], all.into_iter().map(row))
}

fn columns<'a>(columns: impl IntoIterator<Item = &'a Column>) -> String {
    table(&["column", "meaning"], columns.into_iter().map(|c| vec![code(c.name), c.about.into()]))
}

fn advice() -> String {
    METHODS.iter().map(|m| m.about()).map(|a| format!("- `{}`, {}. {}\n", a.id, a.name, one_line(a.advice))).collect()
}

/// Every command with its options. Options of how a record is loaded are listed once.
fn commands() -> String {
    let mut cli = Cli::command();
    cli.build();
    let load: Vec<String> = ids(cli.find_subcommand("inspect").expect("a command")).collect();
    let load: Vec<String> =
        load.into_iter().filter(|id| !["file", "json", "help", "memory"].contains(&&**id)).collect();
    let mut out = String::new();
    for command in std::iter::once(&cli).chain(cli.get_subcommands().filter(|c| !c.is_hide_set())) {
        let name = command.get_bin_name().unwrap_or("wildpoint");
        out += &format!("## {name}\n\n");
        let about =
            command.get_long_about().or_else(|| command.get_about()).map(ToString::to_string).unwrap_or_default();
        out += &format!("{}\n\n", prose(&about));
        let usage = command.clone().render_usage().to_string();
        let usage = one_line(usage.trim_start_matches("Usage:"));
        let example = command.get_before_help().map(ToString::to_string).unwrap_or_default();
        let example = example.trim_start_matches("Example: ");
        out += &format!("```text\n{usage}\n```\n\nExample: `{example}`\n\n");
        let loads = command.get_arguments().any(|arg| arg.get_id() == "encoding") && name != "wildpoint inspect";
        let shown = command.get_arguments().filter(|arg| !arg.is_hide_set() && arg.get_id() != "help");
        let shown: Vec<&Arg> = shown.filter(|arg| !loads || !load.iter().any(|id| arg.get_id() == id)).collect();
        if !shown.is_empty() {
            out += &(table(&["option", "meaning"], shown.into_iter().map(option)) + "\n");
        }
        if loads {
            out += "Options for loading are those of [`wildpoint inspect`](#wildpoint-inspect).\n\n";
        }
    }
    out.trim_end().to_owned() + "\n"
}

fn ids(command: &clap::Command) -> impl Iterator<Item = String> + '_ {
    command.get_arguments().map(|arg| arg.get_id().to_string())
}

/// Text of a help in which angle brackets and asterisks are no markup.
fn prose(text: &str) -> String {
    text.lines().map(str::trim).collect::<Vec<_>>().join("\n")
}

fn option(arg: &Arg) -> Vec<String> {
    let names = arg.get_value_names().map(|n| n.join(" ")).unwrap_or_default();
    let takes = arg.get_num_args().is_none_or(|n| n.takes_values());
    let value = if takes { format!(" {names}") } else { String::new() };
    let spelled = match (arg.get_short(), arg.get_long()) {
        (Some(short), Some(long)) => format!("`-{short}`, `--{long}{value}`"),
        (None, Some(long)) => format!("`--{long}{value}`"),
        _ => format!("`{}`", value.trim()),
    };
    let help = arg.get_long_help().or_else(|| arg.get_help()).map(|h| one_line(&h.to_string())).unwrap_or_default();
    let values: Vec<String> = arg.get_possible_values().iter().map(|v| v.get_name().to_owned()).collect();
    let values = if values.is_empty() || !takes { String::new() } else { format!(" One of: {}.", values.join(", ")) };
    let defaults: Vec<String> = arg.get_default_values().iter().map(|v| v.to_string_lossy().into_owned()).collect();
    let default =
        if defaults.is_empty() || !takes { String::new() } else { format!(" [default: {}]", defaults.join(", ")) };
    let stop = if help.ends_with(['.', ']']) { "" } else { "." };
    vec![spelled, format!("{help}{stop}{values}{default}")]
}
