//! How many threads may work.

use clap::Args;

#[derive(Args, Clone, Copy)]
#[group(skip)]
pub(crate) struct ThreadArguments {
    /// Number of threads; all cores by default. The result does not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
}

impl ThreadArguments {
    /// Limits the threads of everything that follows.
    #[cfg(feature = "rayon")]
    pub(crate) fn apply(self) -> anyhow::Result<()> {
        let Some(count) = self.threads else { return Ok(()) };
        rayon::ThreadPoolBuilder::new()
            .num_threads(count.into())
            .build_global()
            .map_err(|error| anyhow::anyhow!("cannot start {count} threads: {error}"))
    }

    /// This program was built without threads.
    #[cfg(not(feature = "rayon"))]
    pub(crate) fn apply(self) -> anyhow::Result<()> {
        match self.threads {
            None | Some(1) => Ok(()),
            Some(count) => anyhow::bail!(
                "--threads {count}: this program was built without the feature `rayon` and has \
                 one thread"
            ),
        }
    }
}
