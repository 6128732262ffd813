//! Multirevolution method: reduced motions over any number of revolutions, without a step for each of them.

mod circling;
mod follow;
mod frame;
mod place;
mod rates;
mod revolution;
mod section;

pub(super) use follow::follow;
