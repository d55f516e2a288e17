//! Where the outputs of one or many inputs go.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::cli::OutputArgs;
use crate::error::{Error, Result};
use crate::report::ReportForm;
use crate::track::{names_arrays, names_columns, unpacked_name};

/// Where the outputs of one input go.
#[derive(Debug, Clone)]
pub(super) struct Target {
    /// The files to write, and how.
    pub(super) outputs: OutputArgs,
    /// The session to write.
    pub(super) session: Option<PathBuf>,
    /// Folders that the outputs go into, which may have to be made.
    folders: Vec<PathBuf>,
}

impl Target {
    /// Makes the folders that are missing: called when there is something to put into them.
    ///
    /// # Errors
    /// [`Error::Io`] when a folder cannot be made.
    pub(super) fn make_folders(&self) -> Result<()> {
        let make = |folder: &PathBuf| std::fs::create_dir_all(folder).map_err(Error::io("make the folder", folder));
        self.folders.iter().try_for_each(make)
    }
}

/// Where the outputs of each input go. `name` gives the name of its cleaned file. With several inputs, and where a
/// path ends like a folder, the outputs go into folders.
///
/// # Errors
/// [`Error::Usage`] when several inputs would go to one file.
pub(super) fn targets(
    inputs: &[PathBuf],
    outputs: &OutputArgs,
    session: Option<&Path>,
    name: impl Fn(&Path) -> String,
) -> Result<Vec<Target>> {
    let several = inputs.len() > 1;
    let named = [
        outputs.output.as_deref(),
        outputs.changed.as_deref(),
        outputs.flags.as_deref(),
        outputs.diagnostics.as_deref(),
        outputs.report.as_deref(),
        session,
    ];
    for path in named.into_iter().flatten() {
        if several && !is_folder(path, several) {
            return Err(Error::usage(
                format!("{}: several inputs cannot be written to one file", path.display()),
                format!("name a folder: {}/", path.display()),
            ));
        }
    }
    refuse_columns(outputs, session)?;
    // Known before anything is computed: the ending of a report says its form.
    if let Some(report) = outputs.report.as_deref().filter(|path| !is_folder(path, several)) {
        ReportForm::of(report)?;
    }
    let folders: Vec<PathBuf> =
        named.into_iter().flatten().filter(|p| is_folder(p, several)).map(Path::to_path_buf).collect();
    let mut taken: BTreeMap<PathBuf, &Path> = BTreeMap::new();
    let mut targets = Vec::with_capacity(inputs.len());
    for input in inputs {
        let cleaned = name(input);
        let stem = stem(&cleaned).to_owned();
        let mut place = |path: Option<&Path>, file: String| -> Result<Option<PathBuf>> {
            let Some(path) = path else { return Ok(None) };
            if !is_folder(path, several) {
                return Ok(Some(path.to_path_buf()));
            }
            let target = path.join(file);
            match taken.insert(target.clone(), input) {
                Some(other) => Err(Error::usage(
                    format!("{} and {}: both would be {}", other.display(), input.display(), target.display()),
                    "clean them one by one, or give one of them another name",
                )),
                None => Ok(Some(target)),
            }
        };
        let session = place(session, format!("{stem}.toml"))?;
        let outputs = OutputArgs {
            changed: place(outputs.changed.as_deref(), format!("{stem}.changed.csv"))?,
            flags: place(outputs.flags.as_deref(), format!("{stem}.flags.csv"))?,
            diagnostics: place(outputs.diagnostics.as_deref(), format!("{stem}.diagnostics.csv"))?,
            report: place(outputs.report.as_deref(), format!("{stem}.html"))?,
            output: place(outputs.output.as_deref(), cleaned)?,
            ..outputs.clone()
        };
        targets.push(Target { outputs, session, folders: folders.clone() });
    }
    Ok(targets)
}

/// Refuses names of Parquet files for what is none.
fn refuse_columns(outputs: &OutputArgs, session: Option<&Path>) -> Result<()> {
    let packed = outputs.output.as_deref().filter(|path| unpacked_name(&file_name(path)).1.is_some());
    let tables = [
        ("--output", packed, "a Parquet file packs its columns itself", "leave the last ending out"),
        ("--changed", outputs.changed.as_deref(), ONLY_CLEANED, AS_CSV),
        ("--flags", outputs.flags.as_deref(), ONLY_CLEANED, AS_CSV),
        ("--diagnostics", outputs.diagnostics.as_deref(), ONLY_CLEANED, AS_CSV),
        ("--save-session", session, ONLY_CLEANED, "give it a name that ends in .toml"),
    ];
    for (option, path, why, help) in tables {
        if let Some(path) = path.filter(|path| names_columns(path)) {
            return Err(Error::usage(format!("{option} {}: {why}", path.display()), help));
        }
    }
    Ok(())
}

const ONLY_CLEANED: &str = "only the cleaned file (-o) can be a Parquet file";
const AS_CSV: &str = "give it a name that ends in .csv";

/// The name of a file, for its cleaned version: one that is not written has text as its cleaned version.
pub(super) fn file_name(path: &Path) -> String {
    let name = path.file_name().map_or_else(|| "cleaned.csv".into(), |n| n.to_string_lossy().into_owned());
    if names_arrays(path) { format!("{}.csv", stem(&name)) } else { name }
}

/// True for a path that is meant as a folder. With one input a folder that is there has to be written as one, with a
/// separator at its end: it may be a slip.
fn is_folder(path: &Path, several: bool) -> bool {
    let ends_as_one = path.as_os_str().to_string_lossy().ends_with(std::path::is_separator);
    ends_as_one || (several && path.is_dir())
}

/// The name without its ending, and without that of packed files after it.
fn stem(name: &str) -> &str {
    let (name, _) = unpacked_name(name);
    name.rsplit_once('.').map_or(name, |(stem, _)| if stem.is_empty() { name } else { stem })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn args(output: Option<&Path>, flags: Option<&Path>) -> OutputArgs {
        OutputArgs {
            output: output.map(Path::to_path_buf),
            flags: flags.map(Path::to_path_buf),
            ..OutputArgs::default()
        }
    }

    #[test]
    fn each_input_has_its_files_in_the_folders() {
        let dir = tempfile::tempdir().unwrap();
        let (out, flags) = (dir.path().join("out/"), dir.path().to_path_buf());
        let inputs = [PathBuf::from("x/a.csv"), PathBuf::from("y/b.csv.gz")];
        let targets = targets(&inputs, &args(Some(&out), Some(&flags)), Some(&flags), file_name).unwrap();
        assert_eq!(targets[0].outputs.output, Some(out.join("a.csv")));
        assert_eq!(targets[1].outputs.output, Some(out.join("b.csv.gz")), "packed as it was");
        assert_eq!(targets[1].outputs.flags, Some(flags.join("b.flags.csv")));
        assert_eq!(targets[0].session, Some(flags.join("a.toml")));
        assert!(!out.exists(), "made only when there is something to put into it");
        targets[0].make_folders().unwrap();
        assert!(out.is_dir());
    }

    #[test]
    fn two_inputs_never_share_a_file() {
        let dir = tempfile::tempdir().unwrap();
        let one = dir.path().join("one.csv");
        let inputs = [PathBuf::from("x/a.csv"), PathBuf::from("y/a.csv")];
        let to = |path: &Path| targets(&inputs, &args(Some(path), None), None, file_name).unwrap_err().to_string();
        assert!(to(&one).contains("one.csv/"), "a file is refused, and the way out is a folder");
        assert!(!one.exists());
        assert!(to(dir.path()).contains("y/a.csv"), "the same name twice is refused");
        let single = targets(&inputs[..1], &args(Some(&one), None), None, file_name).unwrap();
        assert_eq!(single[0].outputs.output, Some(one));
    }
}
