//! The page of a trial of faults: fault × class of meshes.

use maud::{Markup, html};

use super::super::RenderError;
use super::super::number::count;
use super::super::planted::Tally;
use super::{scroll, shell};
use crate::record::planted::{FaultLine, Planted, PlantingLine};

/// The page.
///
/// # Errors
/// What JSON cannot say (nothing in this schema).
pub fn page(planted: &Planted) -> Result<String, RenderError> {
    let header = header(planted)?;
    let main = html! {
        (missed(planted))
        (matrix(planted))
        (by_property(planted))
        (faults(planted))
        (meshes(planted))
    };
    let sections =
        [("confusion", "Confusion matrix"), ("properties", "Properties"), ("faults", "Faults"), ("meshes", "Meshes")];
    Ok(shell("The jury on trial: planted faults", &sections, header, main))
}

fn header(planted: &Planted) -> Result<Markup, RenderError> {
    let missed = planted.missed().count();
    Ok(html! {
        header {
            p.kicker { "lapjury " (planted.version) }
            h1 { "Planted faults" }
            p.summary {
                (count(planted.faults.len())) " faults on " (count(planted.meshes.len())) " meshes (" (planted.size) ") · seed " (planted.seed) " · "
                @if missed == 0 { span.quiet { "0 missed" } } @else { a.loud href="#missed" { (count(missed)) " missed" } }
            }
            p.digest { "results digest " code { (planted.digest()?) } }
            p.lead {
                "Each fault is planted in a correct operator. Properties see the matrix and the mesh, and no reference. Where none of "
                "them can see a fault, the comparison with the operator that is meant does, and the table says so."
            }
        }
    })
}

fn missed(planted: &Planted) -> Markup {
    html! {
        @if planted.missed().next().is_some() {
            section #missed {
                h2 { "Missed" }
                (scroll("Missed faults", html! {
                    table.list {
                        thead { tr { th { "fault" } th { "mesh" } th { "operator" } th { "others that fail" } } }
                        tbody {
                            @for p in planted.missed() {
                                tr { td { (p.fault) } td { code { (p.mesh) } } td { (p.operator) } td { (p.result.by()) } }
                            }
                        }
                    }
                }))
            }
        }
    }
}

fn matrix(planted: &Planted) -> Markup {
    let classes = planted.classes();
    html! {
        section #confusion {
            h2 { "Confusion matrix" }
            (scroll("Faults and classes of meshes", html! {
                table.matrix {
                    thead {
                        tr {
                            td.corner { "fault \\ meshes" }
                            @for class in &classes { th scope="col" { (class) } }
                        }
                    }
                    tbody {
                        @for fault in &planted.faults {
                            tr {
                                th scope="row" { a.self href={ "#fault-" (fault.id) } { (fault.id) } }
                                @for class in &classes {
                                    (cell(&Tally::of(planted.plantings.iter().filter(|p| of(p, fault, class)))))
                                }
                            }
                        }
                    }
                }
            }))
            p.legend {
                span.key.holds { "SYM 3" } " caught by SYM on three; "
                span.key.undecided { "comparison 2" } " no property can see it there, the comparison does; "
                span.key.undecided { "? 1" } " the change lies between rounding and a defect; "
                span.key.silent { "≈ 1" } " changed by no more than rounding explains; "
                span.key.silent { "·" } " it does not apply or changes nothing; "
                span.key.fails { "✗ missed" } " beyond the band and seen by nothing that must see it."
            }
        }
    }
}

fn of(p: &PlantingLine, fault: &FaultLine, class: &str) -> bool {
    p.fault == fault.id && p.class == class
}

fn cell(tally: &Tally) -> Markup {
    let class = match tally {
        t if t.missed > 0 => "fails",
        t if t.changed() == 0 => "silent",
        t if t.all_caught() == 0 => "undecided",
        _ => "holds",
    };
    let mut words: Vec<String> = tally.caught.iter().map(|(id, n)| format!("{id} {n}")).collect();
    words.extend((tally.missed > 0).then(|| format!("✗ missed {}", tally.missed)));
    words.extend((tally.compared > 0).then(|| format!("comparison {}", tally.compared)));
    words.extend((tally.undecided > 0).then(|| format!("? {}", tally.undecided)));
    words.extend((tally.rounding > 0).then(|| format!("≈ {}", tally.rounding)));
    html! {
        td class=(class) {
            span.numbers {
                @if words.is_empty() { "·" }
                @for (k, word) in words.iter().enumerate() { @if k > 0 { br; } (word) }
            }
        }
    }
}

fn by_property(planted: &Planted) -> Markup {
    let all = Tally::of(planted.plantings.iter());
    html! {
        section #properties {
            h2 { "Properties" }
            p.meta { "How often each was the first of those named to catch a fault; what no property caught is below." }
            table.list {
                thead { tr { th { "seen by" } th.n { "plantings" } } }
                tbody {
                    @for (id, n) in &all.caught { tr { td { (id) } td.n { (count(*n)) } } }
                    tr { td { "the comparison only" } td.n { (count(all.compared)) } }
                    tr { td { "undecided" } td.n { (count(all.undecided)) } }
                    tr { td { "changed within rounding" } td.n { (count(all.rounding)) } }
                    tr { td { "missed" } td.n { (count(all.missed)) } }
                }
            }
        }
    }
}

fn faults(planted: &Planted) -> Markup {
    html! {
        section #faults {
            h2 { "Faults" }
            (scroll("Faults", html! {
                table.list.sortable.filterable {
                    thead { tr { th { "fault" } th { "kind" } th { "what is done" } th { "must be caught by" } th { "seen by the comparison only" } } }
                    tbody {
                        @for f in &planted.faults {
                            tr id={ "fault-" (f.id) } {
                                td { code { (f.id) } }
                                td { (f.class) }
                                td.prose { (f.what) }
                                td { @if f.caught_by.is_empty() { "–" } @else { (f.caught_by.join(", ")) } }
                                td.prose { @if f.blind.is_empty() { "nowhere" } @else { (f.blind.join("; ")) } }
                            }
                        }
                    }
                }
            }))
        }
    }
}

fn meshes(planted: &Planted) -> Markup {
    html! {
        section #meshes {
            h2 { "Meshes" }
            (scroll("Meshes", html! {
                table.list.sortable {
                    thead { tr { th { "mesh" } th { "class" } th.n { "vertices" } th.n { "smallest angle" } } }
                    tbody {
                        @for m in &planted.meshes {
                            tr {
                                td { code { (m.name) } }
                                td { (m.class) }
                                td.n data-v=(m.vertices) { (count(m.vertices)) }
                                td.n data-v=(m.min_angle_deg.unwrap_or(-1.0)) {
                                    @match m.min_angle_deg { Some(a) => (super::super::number::degrees(a)), None => "–" }
                                }
                            }
                        }
                    }
                }
            }))
        }
    }
}
