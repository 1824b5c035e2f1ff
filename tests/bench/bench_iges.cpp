// Speed of the IGES file layer on 128s of full-length reals: index (cards, Global, Directory), lexing, decoding, typed
// records. bench_iges [FILE.igs] measures a real file instead.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <thread>

#include "base/number.h"
#include "formats/iges/records/any.h"
#include "formats/iges/write.h"

using namespace trimloop;
using namespace trimloop::iges;

namespace {

std::string& input() {
  static std::string bytes;
  return bytes;
}

// Bicubic surfaces of 10 x 10 poles, some 6 kB each.
std::string surfaces(int count) {
  Writer writer(Global{});
  for (int n = 0; n < count; ++n) {
    RationalBSplineSurface s;
    s.upper_u = s.upper_v = 9;
    s.degree_u = s.degree_v = 3;
    s.polynomial = true;
    for (int i = 0; i < 14; ++i) s.knots_u.push_back(std::clamp((i - 3) / 7.0, 0.0, 1.0));
    s.knots_v = s.knots_u;
    s.weights.assign(100, 1.0);
    for (int i = 0; i < 100; ++i) s.points.push_back({n + std::sin(i), n + std::cos(i), std::sqrt(i + n)});
    writer.add(DirectoryEntry{}, s);
  }
  return writer.finish().value_or("");
}

void count_bytes(benchmark::State& state) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(input().size()));
}

void index(benchmark::State& state) {
  for (auto _ : state) {
    Report report;
    benchmark::DoNotOptimize(File::parse(input(), {}, report));
  }
  count_bytes(state);
}

template <class Each>
void over_entities(benchmark::State& state, Each each) {
  Report report;
  const File file = File::parse(input(), {}, report);
  Parameters parameters;
  for (auto _ : state)
    for (const DirectoryEntry& entry : file.directory()) {
      file.parameters(entry, parameters, report);
      each(file, entry, parameters, report);
    }
  count_bytes(state);
}

void lex(benchmark::State& state) {
  over_entities(state, [](const File&, const DirectoryEntry&, const Parameters& p, Report&) {
    benchmark::DoNotOptimize(p.tokens.data());
  });
}

void lex_and_decode(benchmark::State& state) {
  double sum = 0;
  over_entities(state, [&](const File&, const DirectoryEntry&, const Parameters& p, Report&) {
    for (const Token& token : p.tokens) sum += read_real(token.text).value;
  });
  benchmark::DoNotOptimize(sum);
}

void lex_and_type(benchmark::State& state) {
  const Limits limits;
  over_entities(state, [&](const File& file, const DirectoryEntry& entry, const Parameters& p, Report& report) {
    benchmark::DoNotOptimize(read_any(file, entry, p, limits, report));
  });
}

// Records of halves of the Directory in threads of their own: a File is read-only, each thread has its Report.
void type_in_threads(benchmark::State& state) {
  const auto jobs = static_cast<std::size_t>(state.range(0));
  Report report;
  const File file = File::parse(input(), {}, report);
  const auto& directory = file.directory();
  const auto share = [&](std::size_t job) {
    Report own;
    Parameters parameters;
    const Limits limits;
    for (std::size_t i = directory.size() * job / jobs; i < directory.size() * (job + 1) / jobs; ++i) {
      file.parameters(directory[i], parameters, own);
      benchmark::DoNotOptimize(read_any(file, directory[i], parameters, limits, own));
    }
  };
  for (auto _ : state) {
    std::vector<std::thread> threads;
    for (std::size_t job = 0; job < jobs; ++job) threads.emplace_back(share, job);
    for (std::thread& t : threads) t.join();
  }
  count_bytes(state);
}

BENCHMARK(index)->Unit(benchmark::kMillisecond);
BENCHMARK(lex)->Unit(benchmark::kMillisecond);
BENCHMARK(lex_and_decode)->Unit(benchmark::kMillisecond);
BENCHMARK(lex_and_type)->Unit(benchmark::kMillisecond);
BENCHMARK(type_in_threads)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc > 1) {
    std::ifstream file(argv[1], std::ios::binary);
    input() = {std::istreambuf_iterator<char>(file), {}};
  } else {
    input() = surfaces(2000);
  }
  benchmark::RunSpecifiedBenchmarks();
}
