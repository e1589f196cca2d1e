//! `qparam unwrap`: read, check, compute, write, report.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::Path;
use std::time::{Duration, Instant};

use clap::ValueEnum;
use qoptimize::atlas::{kept_seams, open, unwrap_charts};
use qoptimize::qembed::BoundaryShape;
use qoptimize::qmesh::charts::cut;
use qoptimize::qmesh::obj::{UvWriteSummary, write_obj};
use qoptimize::qmesh::{Chart, Polygons, QuadMesh, Repairs};
use qoptimize::qsimplify::{SimplifyError, simplify};
use qoptimize::{Atlas, AtlasOptions, Certificate, Method, Options, RunRecord};

use crate::args::{MapArgs, UnwrapArgs};
use crate::boundary;
use crate::choices::{BoundaryChoice, MethodChoice};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::interrupt::Phase;
use crate::islands::{refuse_repairs, trades};
use crate::json_text;
use crate::keep;
use crate::output::{Outputs, Target, together};
use crate::page_report::{self, Source};
use crate::pins;
use crate::progress::{StageTime, Watch};
use crate::report::{
    Head, InputReport, LISTED, Timings, UnwrapReport, done_lines, peak_memory_bytes, unwrap_text,
};
use crate::seams;
use crate::streams::Streams;
use crate::threads;
use crate::translate::{no_atlas, refused};
use crate::worst::{self, WorstReport};

mod notes;
mod places;

use notes::notes;
use places::{output_path, refuse_clashes};

/// What a run has gathered before it computes.
struct Job<'a> {
    arguments: &'a UnwrapArgs,
    options: AtlasOptions,
    input: Input,
    /// What the polygons fall into, opened where that is needed.
    charts: Vec<Chart>,
    repairs: Repairs,
    target: Target,
    /// When time is up.
    deadline: Option<Instant>,
}

pub(crate) fn run(arguments: &UnwrapArgs, typed: &[String], io: &mut Streams<'_>) -> Result<Exit, Failure> {
    let start = Instant::now();
    let options = arguments.options()?;
    let target = Target::new(&output_path(arguments));
    let simplified = arguments.simplified.as_deref().map(Target::new);
    let page = arguments.report.as_deref().map(Target::new);
    refuse_clashes(arguments, &target, simplified.as_ref(), page.as_ref())?;
    for target in [Some(&target), simplified.as_ref(), page.as_ref()].into_iter().flatten() {
        target.probe()?;
    }
    if !arguments.quiet {
        for note in notes(arguments, typed) {
            io.say_err(&format!("note: {note}\n"));
        }
    }

    let mut timings = Timings::default();
    let input = timed(&mut timings.read, || Input::read(&arguments.input, io.stdin))?;
    let mut options = arguments.layout.options(options);
    options.keep = keep::collect(&arguments.layout.keep_uv, &input)?;
    // A limit beyond what the clock can count is none.
    let limit = arguments.time_limit.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    let deadline = limit.and_then(|limit| start.checked_add(limit));
    let (charts, repairs) = timed(&mut timings.build, || charts(arguments, &options, &input, deadline, io))?;
    if let (BoundaryShape::Fixed(positions), Some(path)) =
        (&mut options.map.boundary, &arguments.map.boundary_uv)
    {
        let mesh = only_island("--boundary fixed", &charts, &input)?;
        *positions = boundary::read(path, io.stdin, mesh, &input)?;
    }
    if !arguments.pin.is_empty() || arguments.pins.is_some() {
        let mesh = only_island("pins", &charts, &input)?;
        options.map.pins = pins::read(&arguments.pin, arguments.pins.as_deref(), io.stdin, mesh, &input)?;
    }
    if options.map.symmetric {
        only_island("--symmetric", &charts, &input)?;
    }
    let mut job = Job { arguments, options, input, charts, repairs, target, deadline };
    let (result, stages) = timed(&mut timings.parameterize, || job.compute(io))?;
    timings.stages = stages;
    let html = page.as_ref().map(|_| job.page(&result, io)).transpose()?;
    let worst = job.worst_faces(&result)?;
    let written = timed(&mut timings.write, || {
        let simplified = simplified.as_ref().map(|target| Ok((target, job.simplified(io)?))).transpose()?;
        let page = page.as_ref().zip(html.as_deref());
        together(io.stdout, io.interrupt, |outputs| job.write(outputs, &result, simplified, page))
    })?;
    timings.total = start.elapsed().as_secs_f64();
    job.report(&result, written, worst, timings, io)
}

/// The mesh, where there is but one: places are given in the plane of one island.
fn only_island<'a>(what: &str, charts: &'a [Chart], input: &Input) -> Result<&'a QuadMesh, Failure> {
    match charts {
        [chart] => Ok(&chart.mesh),
        _ => Err(Failure::new(Exit::Usage, format!("{what}: {} has {} islands", input.name, charts.len()))
            .help("places are given in the plane of one island; write each into a file of its own")),
    }
}

/// The charts of the input, cut where it was asked for and where it is needed.
fn charts(
    arguments: &UnwrapArgs,
    options: &AtlasOptions,
    input: &Input,
    deadline: Option<Instant>,
    io: &mut Streams<'_>,
) -> Result<(Vec<Chart>, Repairs), Failure> {
    let mut seams = seams::collect(&arguments.layout.seams, input, io)?;
    seams.extend(kept_seams(input.document.view(), &options.keep).iter());
    let cut = cut(input.document.view(), &seams).map_err(|error| refused(&error, input))?;
    if arguments.layout.strict {
        refuse_repairs(&cut.repairs, input)?;
    }
    if !options.open {
        return Ok((cut.charts, cut.repairs));
    }
    let (count, watch) = (cut.charts.len(), Watch::new(io.interrupt, false).until(deadline));
    let opened = threads::with(arguments.map.threads, || open(cut.charts, &watch))?;
    Ok((opened.map_err(|error| no_atlas(&error, count, input))?, cut.repairs))
}

fn timed<T>(seconds: &mut f64, work: impl FnOnce() -> T) -> T {
    let clock = Instant::now();
    let result = work();
    *seconds = clock.elapsed().as_secs_f64();
    result
}

impl Job<'_> {
    /// The charts are lent for the time of the work: those of large meshes are large.
    fn compute(&mut self, io: &Streams<'_>) -> Result<(Atlas, Vec<StageTime>), Failure> {
        let islands = self.charts.len();
        let needed_as_they_are = self.options.max_stretch.is_some();
        let charts = if needed_as_they_are { self.charts.clone() } else { std::mem::take(&mut self.charts) };
        let watch =
            Watch::new(io.interrupt, io.stderr_is_terminal && !self.arguments.quiet).until(self.deadline);
        let polygons = self.input.document.view();
        let work = || unwrap_charts(polygons, charts, self.repairs.clone(), &self.options, &watch);
        let result = io.interrupt.during(Phase::Watched, || threads::with(self.arguments.map.threads, work));
        let stages = watch.finish();
        let result = result?;
        if io.interrupt.is_requested() {
            return Err(Failure::interrupted());
        }
        let mut result = result.map_err(|error| no_atlas(&error, islands, &self.input))?;
        if !needed_as_they_are {
            self.charts = std::mem::take(&mut result.charts);
        }
        Ok((result, stages))
    }

    /// The page of `--report`.
    fn page(&self, result: &Atlas, io: &Streams<'_>) -> Result<String, Failure> {
        let map = &self.arguments.map;
        let mut input = InputReport::new(&self.input);
        // Pages are sent around.
        input.file = page_report::without_folders(&input.file).to_owned();
        let mut notes = vec![input.line().trim_end().to_owned()];
        notes.push(method_line(map, Some(self.arguments.q)));
        notes.extend(done_lines(
            record(result),
            result.rounding.as_ref(),
            &result.repairs,
            result.seams,
            result.layout.as_ref(),
            &result.islands,
        ));
        let mut settings = options_json(&self.options.map, map.boundary_uv.as_deref());
        settings["layout"] = layout_json(&self.options);
        let source = Source {
            input: &self.input,
            charts: &self.charts,
            repairs: &self.repairs,
            options: &self.options,
            result,
            notes,
            settings,
            q: self.arguments.report_q.as_deref(),
            threads: map.threads,
            draw: io.stderr_is_terminal && !self.arguments.quiet,
        };
        page_report::html(&source, io)
    }

    fn simplified(&self, io: &Streams<'_>) -> Result<Polygons, Failure> {
        let watch = Watch::new(io.interrupt, false);
        let mesh = match &self.charts[..] {
            [chart] => chart.mesh.clone(),
            _ => self.input.mesh()?,
        };
        let simplified =
            io.interrupt.during(Phase::Watched, || simplify(&mesh, &self.options.map.simplify, &watch));
        let simplified = simplified.map_err(|error| match error {
            SimplifyError::Cancelled => Failure::interrupted(),
            other => Failure::new(Exit::Computation, "the mesh could not be simplified").cause(&other),
        })?;
        Ok(simplified.polygons(&mesh))
    }

    fn worst_faces(&self, result: &Atlas) -> Result<Vec<WorstReport>, Failure> {
        let find = || worst::find(&self.input, &self.charts, result, &self.options, self.arguments.worst);
        Ok(threads::with(self.arguments.map.threads, find)?.unwrap_or_default())
    }

    /// Everything that is asked for, streams first, and the UVs before what else there is.
    fn write(
        &self,
        outputs: &mut Outputs<'_>,
        result: &Atlas,
        simplified: Option<(&Target, Polygons)>,
        page: Option<(&Target, &str)>,
    ) -> Result<UvWriteSummary, Failure> {
        type Content<'a> = Box<dyn FnOnce(&mut dyn Write) -> io::Result<()> + 'a>;
        let mut summary = UvWriteSummary::default();
        let uv: Content<'_> = Box::new(|mut writer| {
            summary = self.input.document.write_with_uv(&mut writer, &result.uv)?;
            Ok(())
        });
        let mut contents = vec![(&self.target, uv)];
        if let Some((target, mesh)) = simplified {
            contents.push((target, Box::new(move |mut writer| write_obj(&mut writer, mesh.view(), None))));
        }
        if let Some((target, html)) = page {
            contents.push((target, Box::new(|writer| writer.write_all(html.as_bytes()))));
        }
        contents.sort_by_key(|(target, _)| !target.is_stream());
        for (target, content) in contents {
            outputs.write(target, content)?;
        }
        Ok(summary)
    }

    /// Whether `--max-stretch` could be given, and is not.
    fn may_be_cut(&self) -> bool {
        let (options, map) = (&self.options, &self.options.map);
        let is_held = !map.pins.is_empty() || map.symmetric || !options.keep.is_empty();
        options.max_stretch.is_none() && !is_held && !matches!(map.boundary, BoundaryShape::Fixed(_))
    }

    fn report(
        &self,
        result: &Atlas,
        uv_lines: UvWriteSummary,
        worst_faces: Vec<WorstReport>,
        timings: Timings,
        io: &mut Streams<'_>,
    ) -> Result<Exit, Failure> {
        let arguments = self.arguments;
        let certificate = shortened(&result.certificate);
        let valid = certificate.holds;
        let report = UnwrapReport {
            head: Head::new("unwrap"),
            input: InputReport::new(&self.input),
            output: self.target.to_string(),
            uv_lines,
            valid,
            stopped_by_time: result.islands.iter().any(|island| island.ended_by_time),
            certificate,
            distortion: &result.distortion,
            worst_faces,
            options: options_json(&self.options.map, arguments.map.boundary_uv.as_deref()),
            record: record(result),
            rounding: result.rounding.as_ref(),
            repairs: &result.repairs,
            seams: result.seams,
            trade: trades(result.seams, &result.islands),
            may_be_cut: self.may_be_cut(),
            layout: result.layout,
            layout_options: layout_json(&self.options),
            islands: &result.islands,
            timings_seconds: timings,
            peak_memory_bytes: peak_memory_bytes(),
        };
        // The mesh has standard output for itself when it goes there.
        let aside = self.target == Target::Stdout;
        if arguments.json {
            io.report(aside, &json_text(&report))?;
        } else if !arguments.quiet {
            let color = if aside { io.stderr_color } else { io.stdout_color };
            let text = unwrap_text(&report, &method_line(&arguments.map, Some(arguments.q)), color);
            let page =
                arguments.report.as_deref().map(|path| format!("page written to {}\n", Target::new(path)));
            let page = page.unwrap_or_default();
            io.report(aside, &format!("{text}UVs written to {}\n{page}", report.output))?;
        }
        if report.stopped_by_time && !(arguments.json && aside) {
            io.say_err("note: the time limit ended the work: this is the best map so far\n");
        }
        if valid {
            return Ok(if report.stopped_by_time { Exit::TimeLimit } else { Exit::Done });
        }
        if !(arguments.json && aside) {
            io.say_err(&format!(
                "warning: the UVs are written, but not certified: the certificate {}\n",
                result.certificate
            ));
        }
        Ok(Exit::Invalid)
    }
}

/// No more places than reports list.
fn shortened(certificate: &Certificate) -> Certificate {
    let mut certificate = certificate.clone();
    let mut listed = BTreeMap::new();
    certificate.violations.retain(|violation| {
        let count = listed.entry(violation.kind).or_insert(0);
        *count += 1;
        *count <= LISTED
    });
    certificate
}

/// How the only island came about; of several, nothing that holds for all.
fn record(atlas: &Atlas) -> Option<&RunRecord> {
    match &atlas.islands[..] {
        [island] => Some(&island.record),
        _ => None,
    }
}

/// The options of seams and layout, without those of the map.
fn layout_json(options: &AtlasOptions) -> serde_json::Value {
    let mut value = serde_json::to_value(options).unwrap_or_default();
    if let Some(fields) = value.as_object_mut() {
        fields.remove("map");
    }
    value
}

/// What was asked for, in one line.
pub(crate) fn method_line(map: &MapArgs, q: Option<f64>) -> String {
    fn name(choice: &impl ValueEnum) -> String {
        choice.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }
    let at = |q: Option<f64>| q.map_or_else(String::new, |q| format!(", q {q}"));
    let method = name(&map.method);
    let boundary = match map.boundary {
        BoundaryChoice::Auto | BoundaryChoice::Free if Method::from(map.method).has_free_boundary() => {
            "free boundary".to_owned()
        }
        BoundaryChoice::Auto => "boundary circle".to_owned(),
        other => format!("boundary {}", name(&other)),
    };
    match map.method {
        MethodChoice::Lscm => format!("method {method}, free boundary"),
        MethodChoice::Direct => format!("method {method}{}, shape {}, {boundary}", at(q), map.shape),
        MethodChoice::Paper => format!(
            "method {method}{}, rule {}, weights {}, {boundary}",
            at(q),
            name(&map.rule),
            name(&map.weights)
        ),
        MethodChoice::Conformal => format!("method {method}{}, {boundary}", at(q)),
        _ => format!("method {method}, {boundary}"),
    }
}

/// The options as the library takes them; of a fixed boundary only where it came from and its size.
pub(crate) fn options_json(options: &Options, boundary_file: Option<&Path>) -> serde_json::Value {
    let mut value = serde_json::to_value(options).unwrap_or_default();
    if let (BoundaryShape::Fixed(positions), Some(file)) = (&options.boundary, boundary_file) {
        value["boundary"] = serde_json::json!({ "fixed": { "file": file.display().to_string(), "vertices": positions.len() } });
    }
    value
}
