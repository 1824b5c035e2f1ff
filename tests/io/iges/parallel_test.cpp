// Files imported at the same time give the bits that they give one after another.
#include <algorithm>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <thread>

#include "tests/io/iges/imported.h"
#include "tests/support/corpus.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

// All numbers of a model and of what was found, in order.
std::vector<double> digest(const std::string& bytes) {
  Report report;
  const auto file = iges::File::parse(bytes, {}, report);
  const Model model = io::iges_import::import(file, {}, {}, report);
  std::vector<double> out;
  const auto add = [&](Point p) { out.insert(out.end(), {p.x, p.y, p.z}); };
  for (const Part& part : model.parts) {
    for (const FreeCurve& c : part.curves)
      if (is_bounded(c.curve)) add(start_point(c.curve)), add(end_point(c.curve));
    for (const FreePoint& p : part.points) add(p.point);
    for (const Instance& i : part.instances) add(to_point(i.transform.t));
    for (const Body& body : part.bodies) {
      for (const Vertex& v : body.vertices) add(v.point);
      for (const Face& f : body.faces) out.push_back(static_cast<double>(f.status));
      for (const Loop& loop : body.loops)
        for (const Coedge& c : loop.coedges) {
          const Uv a = start_uv(body, c), b = end_uv(body, c);
          out.insert(out.end(), {a.u, a.v, b.u, b.v, c.gap_mm});
        }
    }
  }
  for (const Diagnostic& d : report.items()) out.push_back(static_cast<double>(d.location.offset + d.text.size()));
  return out;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(parallel)

BOOST_AUTO_TEST_CASE(sixty_four_files_at_once_give_the_same_bits) {
  std::vector<std::filesystem::path> paths = corpus_files("iges");  // the 64 largest of those that import in a moment
  std::erase_if(paths, [](const auto& path) { return std::filesystem::file_size(path) > 400'000; });
  std::stable_sort(paths.begin(), paths.end(), [](const auto& a, const auto& b) { return std::filesystem::file_size(a) > std::filesystem::file_size(b); });
  std::vector<std::string> files;
  for (const auto& path : paths)
    if (files.size() < 64) files.push_back(read_file(path));
  if (files.empty()) {
    BOOST_TEST_MESSAGE("skipped: no public IGES files");
    BOOST_TEST(true);
    return;
  }
  std::vector<std::vector<double>> one_by_one, at_once(files.size());
  for (const std::string& bytes : files) one_by_one.push_back(digest(bytes));
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < files.size(); ++i) threads.emplace_back([&, i] { at_once[i] = digest(files[i]); });
  for (std::thread& t : threads) t.join();
  for (std::size_t i = 0; i < files.size(); ++i) BOOST_TEST(same_bits(one_by_one[i], at_once[i]), "file " << i);
  BOOST_TEST_MESSAGE(files.size() << " files, each in a thread of its own");
}

BOOST_AUTO_TEST_SUITE_END()
