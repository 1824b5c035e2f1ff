// Reading a STEP file: memchr over the bytes as a yardstick, the index, every record as a tape, the model. The file is
// TRIMLOOP_BENCH_STEP, for example of ../shared/tools/make_big.py step 100 SOURCE.step OUT.step.

#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include "formats/step/file.h"
#include "formats/step/tape.h"
#include "io/step/import.h"

namespace {

using namespace trimloop;

const std::string& bytes() {
  static const std::string all = [] {
    const char* path = std::getenv("TRIMLOOP_BENCH_STEP");
    std::ifstream in(path ? path : "tests/data/step/styles.stp", std::ios::binary);
    return std::string((std::istreambuf_iterator<char>(in)), {});
  }();
  return all;
}

void set_rate(benchmark::State& state) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(bytes().size()));
}

void memchr_semicolons(benchmark::State& state) {
  bytes();  // loaded before the clock runs
  for (auto _ : state) {
    std::size_t n = 0;
    const char* at = bytes().data();
    const char* const end = at + bytes().size();
    while ((at = static_cast<const char*>(std::memchr(at, ';', static_cast<std::size_t>(end - at))))) ++n, ++at;
    benchmark::DoNotOptimize(n);
  }
  set_rate(state);
}
BENCHMARK(memchr_semicolons)->Unit(benchmark::kMillisecond);

void index_of_instances(benchmark::State& state) {
  for (auto _ : state) {
    Report report;
    std::string copy = bytes();
    const auto start = std::chrono::steady_clock::now();
    const step::File file = step::File::parse(std::move(copy), Limits{}, report);
    benchmark::DoNotOptimize(file.instances().size());
    state.SetIterationTime(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  set_rate(state);
}
BENCHMARK(index_of_instances)->UseManualTime()->Unit(benchmark::kMillisecond);

void every_record_as_a_tape(benchmark::State& state) {
  Report report;
  const step::File file = step::File::parse(bytes(), Limits{}, report);
  const Limits limits;
  step::Tape tape;
  for (auto _ : state) {
    std::size_t tokens = 0;
    for (const step::Instance& i : file.instances()) {
      tape.read(file.value(i), limits);
      tokens += tape.size();
    }
    benchmark::DoNotOptimize(tokens);
  }
  set_rate(state);
}
BENCHMARK(every_record_as_a_tape)->Unit(benchmark::kMillisecond);

void model_ready(benchmark::State& state) {
  for (auto _ : state) {
    Report report;
    const step::File file = step::File::parse(bytes(), Limits{}, report);
    const Model model = io::step_import::import(file, Execution{}, {}, report);
    benchmark::DoNotOptimize(model.parts.size());
  }
  set_rate(state);
}
BENCHMARK(model_ready)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
