// 100 000 cubic Bézier segments from SVG path data to IGES 126 and back: are the bits the same, and how many segments
// a second pass through each step. bench_svg [segments]
#include <fmt/format.h>

#include <ctime>
#include <cstdlib>
#include <random>

#include "formats/svg/path.h"
#include "io/io.h"

using namespace trimloop;

namespace {

// Processor time of the work alone, not of what is laid ready for it.
template <class Prepare, class Work>
double seconds(Prepare prepare, Work work) {
  double best = infinity;
  for (int i = 0; i < 9; ++i) {
    prepare();
    const std::clock_t start = std::clock();
    work();
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100'000;
  std::mt19937_64 engine(1);
  std::vector<svg::Segment> path;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 100 == 0) path.emplace_back();
    svg::Segment s;
    s.kind = svg::Segment::Kind::Cubic;
    for (auto& p : s.at)
      for (double& c : p) c = static_cast<double>(static_cast<std::int64_t>(engine())) * 0x1p-55;  // 53 significant bits
    path.push_back(s);
  }
  const std::string drawing = "<svg><path d=\"" + svg::path_text(path) + "\"/></svg>";
  io::ReadResult in, back;
  io::WriteOptions to_iges, to_svg;
  to_iges.format = io::Format::Iges;
  to_svg.format = io::Format::Svg;
  std::string iges, again;
  const auto report = [count](const char* what, double s) {
    fmt::print("{:24} {:8.1f} ms  {:6.2f} M segments/s\n", what, 1e3 * s, static_cast<double>(count) / s / 1e6);
    return s;
  };
  std::string bytes;  // the reader takes it over
  double sum = report("SVG text -> model", seconds([&] { in = {}, bytes = drawing; },
                                                   [&] { in = io::read_bytes(std::move(bytes), "x.svg"); }));
  sum += report("model -> IGES text", seconds([&] { iges = {}; },
                                              [&] { iges = io::encode(in.model, in.source, to_iges)->bytes; }));
  report("SVG to IGES", sum);
  sum = report("IGES text -> model", seconds([&] { back = {}, bytes = iges; },
                                             [&] { back = io::read_bytes(std::move(bytes), "x.igs"); }));
  sum += report("model -> SVG text", seconds([&] { again = {}; },
                                             [&] { again = io::encode(back.model, back.source, to_svg)->bytes; }));
  report("IGES to SVG", sum);

  std::vector<svg::Segment> returned;
  for (std::size_t at = again.find(" d=\""); at != std::string::npos; at = again.find(" d=\"", at)) {
    at += 4;
    const auto part = svg::parse_path(std::string_view(again).substr(at, again.find('"', at) - at));
    if (part) returned.insert(returned.end(), part->begin(), part->end());
  }
  std::size_t differ = returned.size() == path.size() ? 0 : count;
  for (std::size_t i = 0; differ == 0 && i < path.size(); ++i) differ += returned[i].at != path[i].at;
  fmt::print("{} segments, {} came back with other bits\n", count, differ);
  return differ ? 1 : 0;
}
