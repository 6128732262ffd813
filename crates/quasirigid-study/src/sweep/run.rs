//! Run of a study: parts one after the other, the rows of a part on a pool of threads of its own, each journalled as it finishes.
//! Rows that exist are not computed again, so that a killed run goes on and shards share a folder.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::time::{Duration, Instant};

use quasirigid_io::record::SweepRecord;
use quasirigid_io::table_file::{csv_header, csv_rows};
use quasirigid_math::memory;
use rayon::ThreadPool;

use super::cell::Cell;
use super::folder::{Folder, REPORT_FILE, ROWS_FILE, SUMMARY, read_part, tidy};
use super::part::Opened;
use super::row::RowAnswer;
use super::{Sweep, SweepError, by_body, page, summary};
use crate::Watch;

/// Most rows that are also written as one CSV file.
const MOST_IN_CSV: u64 = 1_000_000;
/// Time between two looks whether the run is to end.
const PERIOD: Duration = Duration::from_millis(100);
/// Time for which a thread keeps its answers to itself: what a kill loses, and a thousand writes saved.
const TOGETHER: Duration = Duration::from_millis(20);
/// Bytes of an answer in memory, in its row and in its column.
const CELL: usize = size_of::<Cell>() + size_of::<Option<f64>>();
const STAGE: &str = "answering";

/// A share of the parts of a study: those whose number leaves this remainder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Number of the shard, from 1.
    pub index: u64,
    /// Number of shards.
    pub count: u64,
}

/// Settings of a run, none of which changes a result.
#[derive(Clone, Copy, Debug, Default)]
pub struct RunOptions {
    /// Goes on in a folder with results of the study.
    pub resume: bool,
    /// Share of the parts; all of them by default.
    pub shard: Option<Shard>,
    /// Threads; as many as the machine has by default.
    pub threads: Option<usize>,
}

/// End of a run.
#[derive(Clone, Debug)]
pub struct Finished {
    /// Summary, if every part is there.
    pub summary: Option<SweepRecord>,
    /// Parts that are there.
    pub parts_there: u64,
    /// Parts of the study.
    pub parts: u64,
    /// Parts of this run's share that another process has in work.
    pub elsewhere: u64,
    /// Whether the run was told to end.
    pub interrupted: bool,
}

impl Sweep {
    /// Answers every row of the share, into a folder; the bytes of its files depend on the study alone.
    ///
    /// # Errors
    /// [`SweepError`] for a folder that belongs to something else, and for files that cannot be written.
    pub fn run(
        &self,
        folder: &Path,
        options: &RunOptions,
        watch: &mut dyn Watch,
    ) -> Result<Finished, SweepError> {
        if let Some(Shard { index, count }) = options.shard
            && !(1..=count).contains(&index)
        {
            return Err(SweepError::Shard { index, count });
        }
        let threads =
            options.threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, Into::into));
        let pool = pool(threads)?;
        let folder = Folder::open(folder, self, options.resume || options.shard.is_some())?;
        tidy(&folder.path);
        let mine = |part: &u64| options.shard.is_none_or(|shard| part % shard.count == shard.index - 1);
        let parts: Vec<u64> = (0..folder.parts()).filter(mine).collect();
        let total: u64 = parts.iter().map(|part| rows_in(&folder, *part)).sum();
        let mut progress = Progress { watch, done: 0, total, stopped: false };
        let mut elsewhere = 0;
        for part in parts {
            let rows = rows_in(&folder, part);
            if folder.part(part).is_file() {
                folder.check_part(part)?;
                folder.drop_journal(part);
            } else {
                match work_on(self, &folder, part, &pool, &mut progress)? {
                    Worked::Whole => continue,
                    Worked::Stopped => break,
                    Worked::Elsewhere => elsewhere += 1,
                }
            }
            progress.done += rows;
        }
        let interrupted = progress.stopped;
        finished(self, &folder, elsewhere, interrupted)
    }
}

/// End of a run, with the summary if every part is there.
pub(super) fn finished(
    sweep: &Sweep,
    folder: &Folder<'_>,
    elsewhere: u64,
    interrupted: bool,
) -> Result<Finished, SweepError> {
    let parts_there = (0..folder.parts()).filter(|part| folder.part(*part).is_file()).count() as u64;
    let parts = folder.parts();
    let whole = parts_there == parts && !interrupted;
    let summary = if whole { Some(summarized(sweep, folder)?) } else { None };
    Ok(Finished { summary, parts_there, parts, elsewhere, interrupted })
}

fn rows_in(folder: &Folder<'_>, part: u64) -> u64 {
    let rows = folder.rows_of(part);
    rows.end - rows.start
}

impl Sweep {
    /// Answers every row and keeps the answers in memory, in the order of the rows; none if the watch ended the work.
    pub(super) fn in_memory(&self, watch: &mut dyn Watch) -> Result<Option<Vec<RowAnswer>>, SweepError> {
        let row = size_of::<RowAnswer>() + size_of::<u64>() + self.outputs.len() * CELL;
        memory::ask(self.rows as f64 * row as f64)
            .map_err(|cause| SweepError::Memory { rows: self.rows, cause })?;
        let threads = std::thread::available_parallelism().map_or(1, Into::into);
        let todo: Vec<u64> = (0..self.rows).collect();
        let mut answers: Vec<Option<RowAnswer>> = todo.iter().map(|_| None).collect();
        let mut keep = |found: Vec<RowAnswer>| {
            for answer in found {
                let place = answer.row as usize;
                answers[place] = Some(answer);
            }
            Ok(())
        };
        let progress = &mut Progress { watch, done: 0, total: self.rows, stopped: false };
        together(self, &todo, &pool(threads)?, progress, &mut keep)?;
        Ok(answers.into_iter().collect())
    }
}

fn pool(threads: usize) -> Result<ThreadPool, SweepError> {
    crate::watch::pool(threads).map_err(|cause| SweepError::Threads { threads, cause })
}

/// Progress of a run.
struct Progress<'w> {
    watch: &'w mut dyn Watch,
    done: u64,
    total: u64,
    stopped: bool,
}

impl Progress<'_> {
    /// Tells the watch; whether the run is to end.
    fn stop(&mut self) -> bool {
        self.stopped =
            self.stopped || self.watch.at(STAGE, self.done as f64 / self.total.max(1) as f64).is_break();
        self.stopped
    }
}

/// End of the work on a part.
enum Worked {
    Whole,
    Stopped,
    Elsewhere,
}

/// Answers the rows of a part that its journal lacks, and writes the part.
fn work_on(
    sweep: &Sweep,
    folder: &Folder<'_>,
    part: u64,
    pool: &ThreadPool,
    progress: &mut Progress<'_>,
) -> Result<Worked, SweepError> {
    let mut work = match Opened::part(sweep, folder, part)? {
        Opened::Elsewhere => return Ok(Worked::Elsewhere),
        Opened::There => {
            progress.done += rows_in(folder, part);
            return Ok(Worked::Whole);
        }
        Opened::Work(work) => work,
    };
    let todo = work.todo();
    progress.done += rows_in(folder, part) - todo.len() as u64;
    together(sweep, &todo, pool, progress, &mut |answers| work.keep(answers).map(drop))?;
    if !work.is_whole() {
        work.settle()?;
        return Ok(Worked::Stopped);
    }
    work.write(folder)?;
    Ok(Worked::Whole)
}

type Keep<'k> = &'k mut dyn FnMut(Vec<RowAnswer>) -> Result<(), SweepError>;

/// Answers rows on the threads of a pool, in any order; the thread of the caller keeps the answers and asks the watch.
fn together(
    sweep: &Sweep,
    todo: &[u64],
    pool: &ThreadPool,
    progress: &mut Progress<'_>,
    keep: Keep<'_>,
) -> Result<(), SweepError> {
    let cancelled = Arc::new(AtomicBool::new(false));
    let next = std::sync::atomic::AtomicUsize::new(0);
    let (sender, receiver) = mpsc::channel();
    pool.in_place_scope(|scope| {
        for _ in 0..pool.current_num_threads() {
            let (sender, cancelled, next) = (sender.clone(), &cancelled, &next);
            scope.spawn(move |_| {
                let (mut answers, mut sent) = (Vec::new(), Instant::now());
                while let Some(row) = todo.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let Some(answer) = sweep.answer_until(*row, cancelled) else { break };
                    answers.push(answer);
                    if sent.elapsed() >= TOGETHER {
                        let _ = sender.send(std::mem::take(&mut answers)); // the receiver lives as long as the scope
                        sent = Instant::now();
                    }
                }
                let _ = sender.send(answers);
            });
        }
        drop(sender);
        let mut failed = Ok(());
        loop {
            match receiver.recv_timeout(PERIOD) {
                Ok(answers) if failed.is_ok() => {
                    progress.done += answers.len() as u64;
                    failed = keep(answers);
                }
                Err(mpsc::RecvTimeoutError::Disconnected) => return failed,
                Ok(_) | Err(mpsc::RecvTimeoutError::Timeout) => {}
            }
            if progress.stop() || failed.is_err() {
                cancelled.store(true, Ordering::Relaxed);
            }
        }
    })
}

/// Writes the table and the summary of a study whose parts are all there.
fn summarized(sweep: &Sweep, folder: &Folder<'_>) -> Result<SweepRecord, SweepError> {
    if sweep.rows <= MOST_IN_CSV {
        let mut problem = None;
        let written = folder.put(ROWS_FILE, |out| {
            for part in 0..folder.parts() {
                match read_part(&folder.part(part), None) {
                    Ok(columns) => {
                        if part == 0 {
                            out.write_all(&csv_header(&columns))?;
                        }
                        out.write_all(&csv_rows(&columns))?;
                    }
                    Err(error) => {
                        problem = Some(error);
                        return Err(std::io::ErrorKind::InvalidData.into());
                    }
                }
            }
            Ok(())
        });
        if let Some(problem) = problem {
            return Err(problem);
        }
        written?;
    }
    by_body::write(sweep, folder)?;
    let record = summary::of_folder(sweep, folder)?;
    let page = page::page(folder, &record)?;
    folder.put(REPORT_FILE, |out| out.write_all(page.as_bytes()))?;
    folder.put(SUMMARY, |out| writeln!(out, "{:#}", serde_json::json!(record)))?;
    Ok(record)
}
