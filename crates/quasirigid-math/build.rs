//! What the library knows of its own build. Vectors of eight numbers cost a seventh of the compiler's time for what computes on lanes, and change
//! no digit, so that only a build for speed has them.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(vectors_of_eight, optimized)");
    let level = std::env::var("OPT_LEVEL").unwrap_or_default();
    if level == "3" {
        println!("cargo::rustc-cfg=vectors_of_eight");
    }
    if matches!(level.as_str(), "2" | "3") {
        println!("cargo::rustc-cfg=optimized");
    }
}
