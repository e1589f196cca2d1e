//! Small meshes of all kinds through `qparam unwrap`, with options of all kinds.
//!
//! Whatever comes: one of the documented exit codes; a file is complete or absent; a map that is called certified is found to be injective by
//! an independent check with exact integers, and one that is not called so, not; and `qparam check` says the same.

use qparam_cli::{Environment, Exit, Interrupt, Streams};

use super::bytes::Bytes;
use super::exact;
use super::shape::Shape;

pub(crate) fn run(data: &[u8]) {
    let (text, options) = case(data);
    unwrap(&text, &options);
}

/// The mesh and the options that bytes stand for.
pub(crate) fn case(data: &[u8]) -> (String, Vec<String>) {
    let mut bytes = Bytes(data);
    let options = options(&mut bytes);
    let text = Shape::new(&mut bytes).text([0, 0, 1, 3][options.len() % 4]);
    (text, options)
}

/// Unwraps `text` and checks what comes back.
pub(crate) fn unwrap(text: &str, options: &[String]) {
    let mut arguments = vec!["unwrap".to_owned(), "-".to_owned()];
    arguments.extend(options.iter().cloned());
    let unwrapped = qparam(&arguments, text);
    match unwrapped.exit {
        Exit::Done | Exit::Invalid => {}
        Exit::Usage | Exit::Input | Exit::Mesh | Exit::Computation => {
            assert!(unwrapped.stdout.is_empty(), "a failure leaves no file");
            assert!(unwrapped.stderr.contains("error: "), "{}", unwrapped.stderr);
            return;
        }
        other => panic!("exit code {}: {}", other.code(), unwrapped.stderr),
    }
    let places =
        |text: &str| text.lines().filter(|l| l.starts_with("v ")).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(places(text), places(&unwrapped.stdout), "vertices stay");
    let (before, _) = polygons(text);
    let (faces, uv) = polygons(&unwrapped.stdout);
    assert_eq!(before, faces, "faces stay");
    let (faces, uv) = oriented(faces, uv);
    let fault = exact::fault(&faces, &uv);
    assert_eq!(
        unwrapped.exit == Exit::Done,
        fault.is_none(),
        "{fault:?}\n{}\n{options:?}\n{text}",
        unwrapped.stderr
    );
    let checked = qparam(&["check".to_owned(), "-".to_owned()], &unwrapped.stdout);
    assert_eq!(checked.exit, unwrapped.exit, "{}\n{options:?}\n{text}", checked.stdout);
}

struct Ended {
    exit: Exit,
    stdout: String,
    stderr: String,
}

fn qparam(arguments: &[String], text: &str) -> Ended {
    let (mut output, mut messages) = (Vec::new(), Vec::new());
    let mut streams = Streams {
        stdin: &mut text.as_bytes(),
        stdout: &mut output,
        stderr: &mut messages,
        stdout_color: false,
        stderr_color: false,
        stderr_is_terminal: false,
        interrupt: &Interrupt::new(),
    };
    let arguments = ["qparam".into()].into_iter().chain(arguments.iter().map(Into::into));
    let exit = qparam_cli::run(arguments, &Environment::default(), &mut streams);
    let text = |bytes| String::from_utf8(bytes).expect("plain text");
    Ended { exit, stdout: text(output), stderr: text(messages) }
}

fn options(bytes: &mut Bytes<'_>) -> Vec<String> {
    let mut options: Vec<String> = ["--no-config", "--threads", "1"].map(str::to_owned).to_vec();
    let mut add = |words: &[&str]| options.extend(words.iter().map(|&word| word.to_owned()));
    const METHODS: [&str; 7] = ["direct", "conformal", "paper", "uniform", "mean-value", "harmonic", "lscm"];
    // The first method stands for most bytes.
    add(&["--method", METHODS[bytes.below(24).saturating_sub(17)]]);
    add(&["--max-steps", bytes.one(&["20", "3", "0", "100"])]);
    for _ in 0..bytes.below(4) {
        match bytes.below(13) {
            0 => add(&["--boundary", bytes.one(&["circle", "square", "projection", "free"])]),
            1 => add(&["--q", bytes.one(&["0", "1", "0.9", "0.1"])]),
            2 => add(&["--density", bytes.one(&["per-island", "100", "1e-9", "1e9"])]),
            3 => add(&["--seams", bytes.one(&["none", "angle:30", "angle:0", "group", "material", "uv"])]),
            4 => add(&["--max-stretch", bytes.one(&["1.2", "1.05", "2"])]),
            5 => add(&["--strict"]),
            6 => add(&["--up", bytes.one(&["x", "y", "z"])]),
            7 => add(&["--no-pack"]),
            8 => add(&["--uv-precision", "f32"]),
            9 => add(&["--symmetric"]),
            10 => add(&[
                "--resolution",
                bytes.one(&["1", "16", "1048576"]),
                "--margin",
                bytes.one(&["0", "1", "1e9"]),
            ]),
            11 => {
                let vertex = 1 + bytes.below(12);
                let [u, v] = [bytes.coordinate(), bytes.coordinate()];
                add(&["--pin", &format!("{vertex}={u:e},{v:e}")]);
            }
            _ => add(&["--no-normalize"]),
        }
    }
    // Given twice, an option is refused by the parser, which is not what this is about.
    let mut seen = Vec::new();
    let mut kept = Vec::new();
    let mut words = options.into_iter().peekable();
    while let Some(name) = words.next() {
        let mut group = vec![name.clone()];
        group.extend(std::iter::from_fn(|| words.next_if(|word| !word.starts_with("--"))));
        if ["--pin", "--seams"].contains(&&*name) || !seen.contains(&name) {
            kept.extend(group);
        }
        seen.push(name);
    }
    kept
}

/// Faces and the UV of each corner; without UVs none.
fn polygons(text: &str) -> (Vec<Vec<u32>>, Vec<[f64; 2]>) {
    let (mut faces, mut table, mut uv) = (Vec::new(), Vec::new(), Vec::new());
    for line in text.lines() {
        if let Some(place) = line.strip_prefix("vt ") {
            let mut numbers = place.split(' ').map(|x| x.parse().expect("a number"));
            table.push([(); 2].map(|()| numbers.next().expect("two numbers")));
        } else if let Some(corners) = line.strip_prefix("f ") {
            let mut face = Vec::new();
            for corner in corners.split(' ') {
                let mut indices = corner.split('/').map(|index| index.parse::<u32>().expect("an index"));
                face.push(indices.next().expect("a vertex"));
                uv.extend(indices.next().map(|index: u32| table[index as usize - 1]));
            }
            faces.push(face);
        }
    }
    (faces, uv)
}

/// Faces that run clockwise are turned over: which way a face of the file goes is not what this check is about.
fn oriented(mut faces: Vec<Vec<u32>>, mut uv: Vec<[f64; 2]>) -> (Vec<Vec<u32>>, Vec<[f64; 2]>) {
    let mut start = 0;
    for face in &mut faces {
        let places = &mut uv[start..start + face.len()];
        start += face.len();
        let [x, y] = places[0];
        let relative = |p: [f64; 2]| [p[0] - x, p[1] - y];
        let twice_area: f64 = places
            .windows(2)
            .map(|pair| {
                let [p, q] = [relative(pair[0]), relative(pair[1])];
                p[0] * q[1] - p[1] * q[0]
            })
            .sum();
        if twice_area < 0.0 {
            places.reverse();
            face.reverse();
        }
    }
    (faces, uv)
}
