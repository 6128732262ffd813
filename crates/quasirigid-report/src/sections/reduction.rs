use maud::{Markup, html};
use quasirigid_io::record::ReductionRecord;

use super::dissipation::bars;
use super::table::{facts, table};
use crate::number::{digits, short};

/// Size of each degree of the reduced equations, and the order, residual and power of the reduction.
pub fn section(reduction: &ReductionRecord) -> Markup {
    html! {
        section aria-label="Reduced equations" {
            h2 { "Reduced equations at the initial spin" }
            (facts("Reduction", &[
                ("Order p", html! { (reduction.order) }),
                ("Order with the smallest terms at this spin", html! { (reduction.optimal_order) }),
                ("Residual of the invariance equation, relative to the load", html! { (short(reduction.residual)) }),
                ("Mean power dissipated by these equations", html! { (short(reduction.power)) " W" }),
            ]))
            (bars("Dissipation shares at the initial spin", &reduction.dissipation))
            @if reduction.degrees.is_empty() {
                p.absent { "The record holds no degrees." }
            } @else {
                (table("Degrees of dω/dt", &["Degree in ω", "Largest |f| [rad/s²]", "Relative to degree 2"], html! {
                    @for degree in &reduction.degrees {
                        tr {
                            th scope="row" { (degree.degree) }
                            td { (digits(degree.size, 3)) }
                            td { (digits(degree.relative, 3)) }
                        }
                    }
                }))
            }
        }
    }
}
