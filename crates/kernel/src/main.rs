//! `wildpoint-kernel`: applies a session to tracks that come as an Arrow IPC stream on standard input. Engines that
//! distribute an archive over machines start one for each partition.

mod args;
mod output;
mod run;
mod tracks;

use std::io::{BufReader, Write as _};
use std::process::ExitCode;

use clap::Parser as _;

fn main() -> ExitCode {
    let args = args::Args::parse();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(args.threads.max(1));
    if let Err(e) = pool.build_global() {
        return failed(&e);
    }
    let input = BufReader::with_capacity(1 << 20, std::io::stdin().lock());
    match run::run(&args, input, std::io::stdout().lock()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(e) => failed(&e),
    }
}

fn failed(error: &dyn std::fmt::Display) -> ExitCode {
    // Where nobody reads standard error, the exit status is all that can be told.
    let _ = writeln!(std::io::stderr(), "error: {error}");
    ExitCode::from(2)
}
