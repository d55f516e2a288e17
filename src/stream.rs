//! x
pub fn run(
    _: &crate::cli::StreamArgs,
    _: impl std::io::Read,
    _: &mut dyn std::io::Write,
    _: &mut dyn std::io::Write,
) -> crate::error::Result<()> {
    Ok(())
}
