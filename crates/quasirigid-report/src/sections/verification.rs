//! Section on the verification: differences between reduced and full equations as the body is stiffened, and their orders.
//! Curves are drawn for the angular-momentum form alone; the table also has the angular-velocity form, the paper's.
//! Scaling in `ε`: (R1), docs/theory/03-reduction.md.

use maud::{Markup, html};
use quasirigid_io::model::BodyKind;
use quasirigid_io::record::{AverageRecord, OrderRecord, VerificationRecord};

use super::table::table;
use crate::figures::verification::convergence;
use crate::number::{digits, duration, short, tidy};
use crate::verdict::Verdict;

/// The reduced equations against the full ones: the difference, and its fall as the body is stiffened.
pub fn section(kind: BodyKind, verification: &VerificationRecord) -> Markup {
    let VerificationRecord { reached, rotations, duration: seconds, orders, average, average_left_out } =
        verification;
    html! {
        section aria-label="Verification" {
            h2 { "Verification against the full system" }
            p {
                "Both were followed from the slow manifold over " (tidy(*rotations, 4)) " revolutions (" (duration(*seconds))
                "), of the body as it is and of bodies ever stiffer: stiffness " i { "C" } "/ε², damping " i { "B" } "/ε. "
                @if *reached { "The difference in spin falls with every order as the theory predicts." }
                @else { strong.warning { "Not every order is reached." } }
            }
            (convergence(orders).draw())
            (differences(orders))
            @if let Some(average) = average { (mean_power(kind, average)) }
            @if let Some(why) = average_left_out { p.absent { (why) } }
        }
    }
}

/// The average beside the full system.
fn mean_power(
    kind: BodyKind,
    AverageRecord { errors, order, expected, reached, .. }: &AverageRecord,
) -> Markup {
    html! {
        p {
            "The average over the " (kind.nutation()) " at the start has the mean power of a run of the full system to " (first(errors))
            ", relative; with ever stiffer bodies that falls with order "
            (order.map_or_else(|| "that is below what the run resolves".into(), |order| digits(order, 4)))
            " in ε, expected " (expected) ". "
            @if !*reached { strong.warning { "Not reached." } }
        }
    }
}

fn differences(orders: &[OrderRecord]) -> Markup {
    table(
        "Order in ε, and differences at the model's own stiffness",
        &[
            "p",
            "Order, measured",
            "Expected",
            "Spin, relative",
            "Attitude [°]",
            "Energy dissipated [J]",
            "Verdict",
        ],
        html! {
            @for row in orders {
                @let verdict = if row.reached { Verdict::Holds } else { Verdict::Fails };
                tr {
                    th scope="row" { (row.p) @if row.form == "paper" { ", paper's form" } }
                    td { (row.order.map_or_else(|| "below rounding".into(), |order| digits(order, 4))) }
                    td { (row.expected) }
                    td { (first(&row.errors)) }
                    td { (row.attitude.first().map_or_else(String::new, |angle| short(angle.to_degrees()))) }
                    td { (first(&row.dissipated)) " of " (first(&row.dissipation)) }
                    td.word.(verdict.class()) { (verdict.icon()) @if row.reached { " reached" } @else { " not reached" } }
                }
            }
        },
    )
}

fn first(values: &[f64]) -> String {
    values.first().map_or_else(String::new, |value| short(*value))
}
