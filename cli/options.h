#pragma once
// What each verb was asked to do: plain data filled by main.cpp, read by the verb's own file.

#include <optional>
#include <string>
#include <vector>

#include "base/limits.h"
#include "kernel/model/model.h"

namespace trimloop::cli {

// Exit codes, a promise (docs/cli.md).
enum Exit { Done = 0, Findings = 1, Usage = 2, CannotReadOrWrite = 3, LimitReached = 4, OurBug = 5 };

enum class When { Auto, Always, Never };

struct Common {
  bool json = false, quiet = false, force = false, timings = false;
  std::string output;
  When color = When::Auto, progress = When::Auto;
  std::optional<LengthUnit> assume_unit;
  Execution execution;  // jobs, stop token, limits
};

struct InfoOptions {
  std::vector<std::string> files;
  std::string sew = "off";
};
struct CheckOptions {
  std::vector<std::string> files;
  std::string fail_on = "error";
};
struct ExplainOptions {
  std::string id;
  bool list = false;
};
struct FixOptions {
  std::string input, log;
  std::vector<std::string> set;     // "D171:5=0.25"
  std::vector<std::string> select;  // rules, by id or slug
  bool none = false, raw = false, all = false, dry_run = false;
};
struct ConvertOptions {
  std::vector<std::string> paths;  // inputs, and the output last unless -o names it
  std::string sew = "auto";
  std::string to, deflection = "0.1%", unit, report, timestamp, schema = "ap242", iges_profile = "full", iges_bodies = "solids";
  double angle_deg = 20;
  std::size_t max_triangles = 0;  // 0: as many as the bounds need
  bool to_nurbs = false, strict = false;
};
struct NurbsOptions {
  std::vector<std::string> paths;  // input, output
  std::string timestamp, as, text;
  double tolerance_mm = 1e-3, em_mm = 10;
  bool schema = false;
};
struct ViewOptions {
  std::string file;
  std::string deflection = "0.1%";
  double angle_deg = 20;
};
struct PlotOptions {
  std::string file, what, entity, scheme = "catmull-clark";
  std::optional<double> at;
  std::size_t most = 24;
  int rounds = 3;
};
struct DiffOptions {
  std::string first, second;
  double tolerance_mm = 0;  // 0: the larger resolution of the two files
  bool all = false;         // list faces that are the same as well
};
struct DumpOptions {
  std::string file;
  std::vector<std::string> entities;
};

int info(const Common&, const InfoOptions&);
int check(const Common&, const CheckOptions&);
int explain(const Common&, const ExplainOptions&);
int fix(const Common&, const FixOptions&);
int convert(const Common&, const ConvertOptions&);
int nurbs(const Common&, const NurbsOptions&);
int view(const Common&, const ViewOptions&);
int plot(const Common&, const PlotOptions&);
int dump(const Common&, const DumpOptions&);
int diff(const Common&, const DiffOptions&);

}  // namespace trimloop::cli
