//! `cargo xtask refine`: what becomes of a map when the mesh is made finer and finer.
//!
//! A well-posed energy has maps that converge: energy, errors and stretch settle, and neighbouring quads become alike. One that is
//! not elliptic grows shear bands, narrow stripes of quads that are sheared against their neighbours: its energy falls for ever, and
//! the areas of neighbours differ by as much on a fine mesh as on a coarse one.

mod bands;
mod study;

use std::fs;
use std::path::Path;

use clap::Parser;

use crate::arguments;
use qparam_cli::qmesh::{QuadMesh, shapes};
use qparam_cli::qoptimize::{Options, Preset};

use study::{Level, table};

/// Where the table goes, in the workspace.
const FILE: &str = "docs/tables/refine.md";
/// Quads along a side: 10 k, 100 k and 400 k quads.
const SIDES: [usize; 3] = [100, 316, 632];
const QUICK: [usize; 3] = [48, 96, 192];
/// The energies that are not elliptic are looked at up to this size: more is in vain.
const LARGEST_CONTRAST: usize = 316;

/// Map two shapes from formulas at three resolutions and see what converges.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask refine")]
struct Arguments {
    /// 2 k, 9 k and 37 k quads instead of 10 k, 100 k and 400 k, and nothing written
    #[arg(long)]
    quick: bool,
    /// Instead, draw docs/figures/shear-bands.png
    #[arg(long, conflicts_with_all = ["quick", "sides"])]
    picture: bool,
    /// Quads along a side of each mesh, and nothing written
    #[arg(long, value_delimiter = ',', conflicts_with = "quick")]
    sides: Vec<usize>,
}

/// Runs the task.
pub(crate) fn run(arguments: &[String]) -> Result<(), String> {
    arguments::parsed("cargo xtask refine", arguments, refine)
}

/// A shape at any resolution.
type Shape = fn(usize) -> QuadMesh;

const SHAPES: [(&str, Shape); 2] = [("bump", |side| shapes::bump(side, 0.5)), ("nose", shapes::nose)];

fn refine(arguments: &Arguments) -> Result<(), String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("no workspace")?;
    if arguments.picture {
        return bands::write(root);
    }
    let given = !arguments.sides.is_empty();
    let sides = match arguments {
        Arguments { quick: true, .. } => QUICK.to_vec(),
        Arguments { sides, .. } if given => sides.clone(),
        _ => SIDES.to_vec(),
    };
    let mut text = HEAD.to_owned();
    for (name, shape) in SHAPES {
        text += &format!(
            "\n## {name}\n\nAt the defaults, but for where the descent ends:\n\n{}",
            table(&levels(shape, &sides, &followed_down(Options::default()))?)
        );
        let paper = Preset::PaperErrors.options();
        let sides: Vec<usize> = sides.iter().copied().filter(|&side| side <= LARGEST_CONTRAST).collect();
        text += &format!(
            "\nFor contrast, with the preset `paper-errors`, which is not elliptic at these stretches:\n\n{}",
            table(&levels(shape, &sides, &followed_down(paper))?)
        );
    }
    println!("{text}");
    if arguments.quick || given {
        return Ok(());
    }
    fs::write(root.join(FILE), &text).map_err(|error| format!("{FILE}: {error}"))
}

/// The same energy, followed further down: from mesh to mesh its minimum changes by less than what ends a descent by default.
fn followed_down(mut options: Options) -> Options {
    options.direct.descent.relative_decrease = 1e-6;
    options
}

fn levels(shape: Shape, sides: &[usize], options: &Options) -> Result<Vec<Level>, String> {
    let level = |&side: &usize| {
        eprintln!("{} quads", side * side);
        Level::of(&shape(side), options)
    };
    sides.iter().map(level).collect()
}

const HEAD: &str = "# Refinement\n\nWritten by `cargo xtask refine`. The same shape with more and more quads, mapped by `direct`. \
    In brackets: the change from the mesh before,\nin per cent. Eqs. 13 and 14 are means over the corners. Where the maps converge, \
    changes shrink from mesh to mesh.\nDescents end at a promised decrease of 1e-6, not at the 1e-5 of the defaults: from mesh to mesh \
    the minimum changes by less than that.\n*Step of areas*: by how much the area ratios (plane over space) of two quads that share an edge differ at most, inside, and where one \
    of them\ntouches the boundary. Where the maps converge to a smooth one, it shrinks like the quads' sides; across a shear band it stays. (A single quad in \
    a corner of\nthe square may stand out on the finest mesh: its share of the energy is below what ends the descent.)\n\n\
    ![Area heat maps of nose with 100,000 quads: smooth at the defaults, streaked with the preset paper-errors](../figures/shear-bands.png)\n\n\
    *The areas of nose with 99,856 quads, each energy followed down as far as 200 steps go (`cargo xtask refine --picture`). Left the defaults, smooth; right the \
    preset\n`paper-errors`, whose energy is not elliptic at these stretches: streaks of sheared quads appear behind the nose, and the descent does not \
    end.\nWhere it ends by its usual rule, after fewer steps, they have hardly begun; the report names the corners beyond the range.*\n";

#[cfg(test)]
mod tests {
    use super::*;

    /// The theorem, as far as three meshes show it: at the defaults energy, errors and stretch differ less and less, by a factor of two a
    /// level and more; the largest s1/s2 grows by less than 2 % a level; and neighbours become alike, as they do not across a shear band.
    #[test]
    fn maps_converge_when_the_mesh_is_refined() {
        for (name, shape) in SHAPES {
            let levels = levels(shape, &QUICK, &followed_down(Options::default())).unwrap();
            let [coarse, middle, fine] = &levels[..] else { unreachable!("three sides") };
            assert!(levels.iter().all(|level| level.certified && level.converged), "{name}");
            for (what, value) in study::FIGURES.iter().take(study::CONVERGING) {
                let (first, second) =
                    ((value(middle) - value(coarse)).abs(), (value(fine) - value(middle)).abs());
                assert!(second <= 0.5 * first, "{name}: {what} changes by {first:e}, then by {second:e}");
            }
            let largest = [coarse, middle, fine].map(|level| level.ratio_max);
            assert!(largest[1] < 1.02 * largest[0] && largest[2] < 1.02 * largest[1], "{name}: {largest:?}");
            let steps = [coarse, middle, fine].map(|level| level.area_steps[0]);
            assert!(steps[1] < 0.6 * steps[0] && steps[2] < 0.6 * steps[1], "{name}: {steps:?}");
        }
    }
}
