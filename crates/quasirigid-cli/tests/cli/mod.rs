//! The command line as its users meet it: output, files and exit code of each command.

mod about_spin;
#[cfg(unix)]
mod appeared;
mod attitude_files;
mod audit;
mod catalogues;
mod check;
mod coils;
mod colour;
mod complete;
mod controllers;
mod derive;
mod docs;
mod effective_masses;
mod evolve;
mod export;
#[cfg(unix)]
mod faults;
mod files;
mod fills;
mod full;
mod help;
mod hostile_names;
mod infer;
mod inputs;
#[cfg(unix)]
mod interrupt;
mod keys;
mod left_out;
mod lightcurve;
mod linear;
mod materials;
mod model_errors;
mod modes;
mod new;
#[cfg(unix)]
mod odd_files;
mod plot;
mod reference;
#[cfg(unix)]
mod resume;
mod run;
mod run_folder;
mod simulate;
mod simulate_refusals;
mod standard_input;
mod structures;
mod sweep;
mod width;
mod yorp;
