//! Which vector arithmetic the library holds: vectors of eight numbers cost a seventh of the compiler's time for what computes on lanes, and change
//! no digit, so that only a build for speed has them.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(vectors_of_eight)");
    if std::env::var("OPT_LEVEL").is_ok_and(|level| level == "3") {
        println!("cargo::rustc-cfg=vectors_of_eight");
    }
}
