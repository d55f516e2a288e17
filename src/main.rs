//! The program `wildpoint`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(wildpoint::program::run(std::env::args_os()))
}
