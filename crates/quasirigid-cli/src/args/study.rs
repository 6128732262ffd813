//! Options of `sweep`.

use std::path::PathBuf;

use clap::Args;
use quasirigid_study::settings::Setting;
use quasirigid_study::sweep::Shard;

#[derive(Args, Debug)]
pub struct SweepArgs {
    /// Study file: the model, what is varied in it, and what is asked
    #[arg(value_name = "STUDY.toml")]
    pub study: PathBuf,
    /// Folder for the results [default: the study's name with -sweep]
    #[arg(long, short, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Go on where an earlier run of the same study ended
    #[arg(long)]
    pub resume: bool,
    /// Share of the parts that this process answers, for job arrays; shards may share a folder
    #[arg(long, value_name = "K/N", value_parser = shard)]
    pub shard: Option<Shard>,
    #[arg(long, help = Setting::Threads.help(), value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Print the model of one row, counted from 1, and its answers, and write nothing
    #[arg(long, value_name = "I", conflicts_with_all = ["out", "resume", "shard", "threads"])]
    pub row: Option<u64>,
    /// Print results for machines, as one JSON object
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors, and with --json the result
    #[arg(long, short)]
    pub quiet: bool,
}

/// Reads a shard such as 1/3.
fn shard(text: &str) -> Result<Shard, String> {
    let numbers =
        text.split_once('/').and_then(|(index, count)| Some((index.parse().ok()?, count.parse().ok()?)));
    match numbers {
        Some((index, count)) if (1..=count).contains(&index) => Ok(Shard { index, count }),
        _ => Err("write K/N with K from 1 to N, such as 1/3".to_owned()),
    }
}
