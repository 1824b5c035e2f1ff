// The command line: words to options (CLI11, in this file only), then one function per verb. See docs/cli.md.

#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <new>
#include <thread>

#include "cli/terminal.h"

namespace trimloop::cli {
namespace {

const std::map<std::string, When> when_words{{"auto", When::Auto}, {"always", When::Always}, {"never", When::Never}};
const std::map<std::string, LengthUnit> unit_words{
    {"mm", LengthUnit::Millimetre}, {"cm", LengthUnit::Centimetre}, {"m", LengthUnit::Metre},
    {"km", LengthUnit::Kilometre},  {"um", LengthUnit::Micron},     {"inch", LengthUnit::Inch},
    {"in", LengthUnit::Inch},       {"foot", LengthUnit::Foot},     {"mile", LengthUnit::Mile},
    {"mil", LengthUnit::Mil}};

struct Words {  // what CLI11 fills before it becomes Common
  Common common;
  std::string assume_unit;
};

void add_common(CLI::App& verb, Words& words) {
  Common& c = words.common;
  Limits& limits = c.execution.limits;
  verb.add_flag("--json", c.json, "Machine-readable output");
  verb.add_option("-o,--output", c.output, "Write to this file (for convert: file or folder)");
  verb.add_flag("-q,--quiet", c.quiet, "No words on standard error but errors");
  verb.add_option("--jobs", c.execution.jobs, "Threads; results do not depend on it")->check(CLI::Range(1, 1024));
  verb.add_option("--color", c.color, "auto, always or never")->transform(CLI::CheckedTransformer(when_words));
  verb.add_option("--progress", c.progress, "auto, always or never")->transform(CLI::CheckedTransformer(when_words));
  verb.add_flag("--force", c.force, "Overwrite existing files");
  verb.add_flag("--timings", c.timings, "Say how long each stage took");
  verb.add_option("--assume-unit", words.assume_unit, "Unit where the file states none that is valid")
      ->check(CLI::IsMember(unit_words));
  verb.add_option("--limit-size", limits.file_bytes, "Largest input, bytes")->transform(CLI::AsSizeValue(false));
  verb.add_option("--limit-memory", limits.memory_bytes, "Most memory, bytes")->transform(CLI::AsSizeValue(false));
  verb.add_option("--limit-time", limits.seconds, "Longest run, seconds");
  verb.add_option("--limit-depth", limits.nesting_depth, "Deepest nesting of references");
  verb.add_option("--limit-count", limits.list_count, "Longest list in one record");
  verb.add_option("--limit-instances", limits.instances, "Most occurrences after expansion");
}

// Ctrl-C and --limit-time set the stop token from a thread of their own; the work ends at its next poll.
void watch(std::stop_source stop, double seconds) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals, stop, seconds]() mutable {
    if (seconds > 0) {
      timespec wait{};
      wait.tv_sec = static_cast<time_t>(seconds);
      wait.tv_nsec = static_cast<long>((seconds - static_cast<double>(wait.tv_sec)) * 1e9);
      sigtimedwait(&signals, nullptr, &wait);
    } else {
      int signal = 0;
      sigwait(&signals, &signal);
    }
    stop.request_stop();
    int again = 0;
    sigwait(&signals, &again);
    std::_Exit(LimitReached);  // a second Ctrl-C does not wait; outputs are renamed into place only when whole
  }).detach();
}

void limit_memory(std::size_t bytes) {
  if (bytes >= Limits{}.memory_bytes) return;
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_AS, &limit);
}

int run(int argc, char** argv) {
  CLI::App app{"trimloop: open, check, convert and look at IGES files, honestly.\n"
               "`trimloop FILE` is `trimloop info FILE`."};
  app.set_version_flag("--version", "trimloop " TRIMLOOP_VERSION);
  app.require_subcommand(1);
  app.footer("Examples:\n  trimloop part.igs\n  trimloop check part.igs\n  trimloop convert part.igs part.glb\n"
             "  trimloop view part.igs\n  trimloop explain IG-E144-02");
  Words words;

  InfoOptions info_options;
  auto* info_verb = app.add_subcommand("info", "What is in it: format, sender, units, entities, faces, box, area, volume");
  info_verb->add_option("FILE", info_options.files, "Files; - is standard input")->required();

  info_verb->add_option("--sew", info_options.sew, "Join faces edge to edge first: auto, off or a length in mm");

  CheckOptions check_options;
  auto* check_verb = app.add_subcommand("check", "Findings with rule id, place, measured value and limit");
  check_verb->add_option("FILE", check_options.files, "Files; - is standard input")->required();
  check_verb->add_option("--fail-on", check_options.fail_on, "Least severity that gives exit code 1")
      ->check(CLI::IsMember({"fatal", "error", "warning", "info", "hint"}));

  ExplainOptions explain_options;
  auto* explain_verb = app.add_subcommand("explain", "What a finding means, why it hurts and what to do");
  explain_verb->add_option("ID", explain_options.id, "Rule id or slug, for example IG-E144-02");
  explain_verb->add_flag("--list", explain_options.list, "Every rule, a line each");

  FixOptions fix_options;
  std::vector<std::string> fix_paths;
  auto* fix_verb = app.add_subcommand("fix", "Repair without touching what is sound (--none: change nothing)");
  fix_verb->add_option("PATHS", fix_paths, "IN OUT")->required()->expected(1, 2);
  fix_verb->add_flag("--none", fix_options.none, "Repair nothing: the output equals the input byte for byte");
  fix_verb->add_option("--set", fix_options.set, "One parameter: D171:5=0.25 or #42:2.3=0.25; nothing else changes but what must move with it")
      ->allow_extra_args(false);
  fix_verb->add_flag("--raw", fix_options.raw, "The value of --set stands in the file as it is typed");
  fix_verb->add_option("--log", fix_options.log, "A line for every change");
  fix_verb->add_flag("--all", fix_options.all, "Every repair that cannot change what the file means; `explain ID` says whether there is one");
  fix_verb->add_option("--select", fix_options.select, "Repair these rules only: ids or slugs")->delimiter(',')->allow_extra_args(false);
  fix_verb->add_flag("--dry-run", fix_options.dry_run, "Say what would change, as a log on standard output; write nothing");

  ConvertOptions convert_options;
  auto* convert_verb = app.add_subcommand("convert", "Any readable format to any writable one, by extension or --to");
  convert_verb->add_option("PATHS", convert_options.paths, "IN OUT, or IN... with -o DIR/")->required();
  convert_verb->add_option("--to", convert_options.to, "iges, step, stl, obj, ply or glb")
      ->check(CLI::IsMember({"iges", "igs", "stl", "obj", "ply", "glb", "step", "stp", "svg", "json"}));
  convert_verb->add_option("--deflection", convert_options.deflection, "Length in mm, or share of the diagonal (0.1%)");
  convert_verb->add_option("--angle", convert_options.angle_deg, "Largest turn of the normal over a triangle side, degrees")
      ->check(CLI::Range(0.1, 180.0));
  convert_verb->add_option("--max-triangles", convert_options.max_triangles,
                           "Not more than so many: deflection and angle are widened until it holds, and the result says how far it is off")
      ->check(CLI::PositiveNumber);
  convert_verb->add_option("--unit", convert_options.unit, "Length unit of the output")->check(CLI::IsMember(unit_words));
  convert_verb->add_option("--schema", convert_options.schema, "STEP application protocol: ap242 or ap214")
      ->check(CLI::IsMember({"ap242", "ap214"}));
  convert_verb->add_option("--iges-profile", convert_options.iges_profile,
                           "full: IGES 5.3; conservative: explicit borders, no pole vertices in loops, ASCII text")
      ->check(CLI::IsMember({"full", "conservative"}));
  convert_verb->add_option("--iges-bodies", convert_options.iges_bodies, "Bodies as solids (186, 514) or as trimmed surfaces (144)")
      ->check(CLI::IsMember({"solids", "surfaces"}));
  convert_verb->add_flag("--to-nurbs", convert_options.to_nurbs, "Every curve and surface as 126 and 128");
  convert_verb->add_flag("--strict", convert_options.strict, "Any loss is exit code 1 and writes nothing");
  convert_verb->add_option("--report", convert_options.report, "Write a JSON report of every face");
  convert_verb->add_option("--timestamp", convert_options.timestamp, "Time stamp of the output (YYYYMMDD.HHNNSS)");
  convert_verb->add_option("--sew", convert_options.sew,
                           "Join faces edge to edge: auto (gaps up to 10 x the file's resolution), off, or a length in mm");
  double min_angle = 0;
  auto* min_angle_option = convert_verb->add_option("--min-angle", min_angle, "Not built yet");

  NurbsOptions nurbs_options;
  auto* nurbs_verb = app.add_subcommand("nurbs", "Every curve and surface as NURBS (126/128), each stated exact or with its deviation");
  nurbs_verb->add_option("PATHS", nurbs_options.paths,
                         "IN OUT: from IGES, STEP, a description (.json), points (.csv), a drawing (.svg), a control mesh (.obj) or a font "
                         "(.ttf, .otf with --text); to .igs, .stp, .glb, .svg or .json")
      ->expected(1, 2);
  nurbs_verb->add_option("--as", nurbs_options.as, "bezier: the Bézier pieces of everything, as .json or .svg")->check(CLI::IsMember({"bezier"}));
  nurbs_verb->add_option("--text", nurbs_options.text, "What to set in a font");
  nurbs_verb->add_option("--em", nurbs_options.em_mm, "Em square of the text, mm")->check(CLI::PositiveNumber);
  nurbs_verb->add_option("--tolerance", nurbs_options.tolerance_mm, "Of what has no exact form in a control mesh, mm")->check(CLI::PositiveNumber);
  nurbs_verb->add_flag("--schema", nurbs_options.schema, "Print the JSON schema of descriptions");
  nurbs_verb->add_option("--timestamp", nurbs_options.timestamp, "Time stamp of the output (YYYYMMDD.HHNNSS)");

  ViewOptions view_options;
  auto* view_verb = app.add_subcommand("view", "One self-contained HTML page: orbit, tree, pick a face");
  view_verb->add_option("FILE", view_options.file, "File; - is standard input")->required();
  view_verb->add_option("--deflection", view_options.deflection, "Length in mm, or share of the diagonal (0.1%)");
  view_verb->add_option("--angle", view_options.angle_deg, "Largest turn of the normal, degrees")->check(CLI::Range(0.1, 180.0));

  PlotOptions plot_options;
  auto* plot_verb = app.add_subcommand("plot", "Pictures (SVG): parameter space of faces, curves, knots, control nets, curvature");
  plot_verb->add_option("FILE", plot_options.file, "File; - is standard input")->required();
  plot_verb->add_option("--what", plot_options.what,
                        "trims (default where there are faces; failed and healed ones first), curve, hodograph, comb, basis, blossom, knots, "
                        "net, isocurves, annotation, gaussian, zebra, shaded, or subdivision (of an .obj)")
      ->check(CLI::IsMember({"trims", "curve", "hodograph", "comb", "basis", "blossom", "knots", "net", "isocurves", "annotation", "gaussian", "zebra", "shaded", "subdivision"}));
  plot_verb->add_option("--entity", plot_options.entity, "Only what comes from this entity: D171, #42");
  plot_verb->add_option("--at", plot_options.at, "Parameter of the blossom");
  plot_verb->add_option("--most", plot_options.most, "Most drawings on the sheet");
  plot_verb->add_option("--scheme", plot_options.scheme, "Of subdivision: catmull-clark, doo-sabin, doo-sabin-midpoint, loop, butterfly, mid-edge, sqrt3");
  plot_verb->add_option("--rounds", plot_options.rounds, "Of subdivision")->check(CLI::Range(0, 8));

  DumpOptions dump_options;
  auto* dump_verb = app.add_subcommand("dump", "One record as the file has it and as it was understood");
  dump_verb->add_option("FILE", dump_options.file, "File; - is standard input")->required();
  dump_verb->add_option("ENTITY", dump_options.entities, "D171 or 171; none: all");

  DiffOptions diff_options;
  auto* diff_verb = app.add_subcommand("diff", "Two files compared, across formats: entities, faces, names, colours");
  diff_verb->add_option("A", diff_options.first, "First file")->required();
  diff_verb->add_option("B", diff_options.second, "Second file")->required();
  diff_verb->add_option("--tolerance", diff_options.tolerance_mm, "Distance in mm within which shapes are the same")
      ->check(CLI::PositiveNumber);
  diff_verb->add_flag("--all", diff_options.all, "List every face with its deviation, those that are the same as well");

  for (auto* verb : {info_verb, check_verb, explain_verb, fix_verb, convert_verb, nurbs_verb, view_verb, plot_verb, dump_verb,
                     diff_verb}) {
    add_common(*verb, words);
  }

  // `trimloop FILE` is `trimloop info FILE`.
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (!arguments.empty() && (arguments[0] == "-" || arguments[0].empty() || arguments[0][0] != '-')) {
    const auto verbs = app.get_subcommands([](CLI::App*) { return true; });
    const bool is_verb = std::any_of(verbs.begin(), verbs.end(), [&](CLI::App* v) { return v->get_name() == arguments[0]; });
    const bool is_file = arguments[0] == "-" || arguments[0].find_first_of("./") != std::string::npos;
    if (!is_verb && is_file) arguments.insert(arguments.begin(), "info");
  }
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? Done : Usage;
  }

  Common& common = words.common;
  if (!words.assume_unit.empty()) common.assume_unit = unit_words.at(words.assume_unit);
  std::stop_source stop;
  common.execution.stop = stop.get_token();
  watch(stop, common.execution.limits.seconds);
  limit_memory(common.execution.limits.memory_bytes);

  const auto not_built = [&](std::string_view what) {
    complain(common, fmt::format("{} is promised and not built yet", what), "trimloop --help");
    return Usage;
  };
  if (*info_verb) return info(common, info_options);
  if (*check_verb) return check(common, check_options);
  if (*explain_verb) return explain(common, explain_options);
  if (*fix_verb) {
    if (!fix_options.none && !fix_options.all && fix_options.select.empty() && fix_options.set.empty()) {
      complain(common, "fix does nothing on its own: --all, --select RULE, --set or --none", "trimloop fix --all --dry-run FILE");
      return Usage;
    }
    fix_options.input = fix_paths[0];
    if (fix_paths.size() == 2 && common.output.empty()) common.output = fix_paths[1];
    return fix(common, fix_options);
  }
  if (*convert_verb) {
    if (*min_angle_option) return not_built("--min-angle");
    return convert(common, convert_options);
  }
  if (*nurbs_verb) return nurbs(common, nurbs_options);
  if (*view_verb) return view(common, view_options);
  if (*plot_verb) return plot(common, plot_options);
  if (*diff_verb) return diff(common, diff_options);
  return dump(common, dump_options);
}

}  // namespace
}  // namespace trimloop::cli

int main(int argc, char** argv) {
  // Library code does not throw; what the standard library throws is our bug or the memory ceiling.
  try {
    return trimloop::cli::run(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("trimloop: error: out of memory (--limit-memory sets the ceiling)\n", stderr);
    return trimloop::cli::LimitReached;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "trimloop: internal error: %s\n", error.what());
    return trimloop::cli::OurBug;
  }
}
