//! Laws that hold for every body: random carriers, points, springs and hinges, in random units.
//!
//! `PROPTEST_CASES` and `PROPTEST_RNG_SEED` widen the search; without them every run tries the same bodies.

mod compare;
mod envelope;
mod evolution;
mod forced;
mod ray;
mod wobbler;

mod angular_momentum_form;
mod axes_and_units;
mod budget;
mod campbell;
mod checkpoints;
mod cutting;
mod degrees;
mod drift;
mod drift_endings;
mod ellipsoid_passages;
mod ellipsoids;
mod energy_form;
mod energy_range;
mod ensembles;
mod forces;
mod forms;
mod full;
mod gravity;
mod harmonics;
mod hinged_lagrangian;
mod inertia;
mod invariants;
mod lagrangian;
mod mechanisms;
mod multirevolution;
mod neutral_modes;
mod nutation;
mod orbits;
mod orders;
mod outcomes;
mod places;
mod poinsot;
mod pole;
mod propagation;
mod refused;
mod refused_forces;
mod rheology;
mod slender;
mod solids;
mod spin_modes;
mod springs;
mod steady_runs;
mod steady_states;
mod verification;
mod vibrations;
mod wobble_rate;
mod wobbles_of_random_bodies;
