// One benchmark for each part of a run, on the paper's conductive case at n = 64, 128, 256, so that
// a regression has an address.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "body/derived.h"
#include "condensation/condensed_body.h"
#include "output/vtu.h"
#include "run/process.h"
#include "solve/condensed_route.h"
#include "solve/interface_newton.h"
#include "tourmaline/case/reader.h"

namespace tourmaline {
namespace {

casefile::Case paper(int n) {
  return casefile::read_file(TOURMALINE_SOURCE_DIR "/cases/ouafik-2020/conductive.toml",
                             {fmt::format("mesh.box.cells=[{0},{0}]", n)});
}

const solve::Model<2> &model(int n) {
  static std::map<int, std::unique_ptr<solve::Model<2>>> models;
  auto &made = models[n];
  if (!made)
    made = std::make_unique<solve::Model<2>>(paper(n));
  return *made;
}

std::vector<body::Node> contact_nodes(const solve::Model<2> &m) {
  std::vector<body::Node> nodes;
  for (const auto &at : m.interface)
    nodes.push_back(at.node);
  return nodes;
}

void mesh_and_assembly(benchmark::State &state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(solve::Model<2>(paper(static_cast<int>(state.range(0)))));
}

void history_product(benchmark::State &state) {
  const auto &m = model(static_cast<int>(state.range(0)));
  const std::vector<double> x(m.n_unknowns(), 1.);
  std::vector<double> y(x.size(), 0.);
  for (auto _ : state)
    m.op.add_history(x, y);
}

void factorise_and_condense(benchmark::State &state) {
  const auto &m = model(static_cast<int>(state.range(0)));
  for (auto _ : state)
    condensation::CondensedBody<2>(m.body, m.op, m.step, m.prescribed, contact_nodes(m), {});
}

void reduce_and_expand(benchmark::State &state) {
  const auto &m = model(static_cast<int>(state.range(0)));
  condensation::CondensedBody<2> condensed(m.body, m.op, m.step, m.prescribed, contact_nodes(m),
                                           {});
  const std::vector<double> b(m.n_unknowns(), 1e-6);
  std::vector<double> x(m.n_unknowns(), 0.);
  for (auto _ : state)
    condensed.expand(condensed.reduce(b, x), x);
}

// A contact problem like the paper's first step: a kernel that decays along the contact, loads at
// the ends.
void interface_newton(benchmark::State &state) {
  const Eigen::Index n = state.range(0) + 1;
  const Eigen::MatrixXd stiffness =
      Eigen::MatrixXd::NullaryExpr(n, n, [](Eigen::Index i, Eigen::Index j) {
        return i == j ? 4. : -1 / (1 + static_cast<double>((i - j) * (i - j)));
      });
  const Eigen::VectorXd force = Eigen::VectorXd::NullaryExpr(n, [n](Eigen::Index i) {
    const double x = 2 * static_cast<double>(i) / static_cast<double>(n) - 1;
    return x * x * x * 3;
  });
  std::vector<solve::ContactPoint> points;
  for (Eigen::Index i = 0; i < n; ++i)
    points.push_back({i, 1, 1, contact::Tresca{0.5}});
  for (auto _ : state)
    benchmark::DoNotOptimize(
        solve::minimise({stiffness, force, points}, Eigen::VectorXd::Zero(n), {}));
}

void vtu_output(benchmark::State &state) {
  const auto &m = model(static_cast<int>(state.range(0)));
  const std::vector<double> x(m.n_unknowns(), 1e-9);
  const output::Grid grid = m.body.grid();
  output::VtuWriter writer(grid);
  output::PointFields points;
  points.displacement.resize(grid.points.size());
  points.potential.resize(grid.points.size());
  points.temperature.resize(grid.points.size());
  const auto file = std::filesystem::temp_directory_path() / "tourmaline-bench.vtu";
  for (auto _ : state)
    writer.write(file, 0, points, body::derived_fields(m.body, m.composition, x));
  std::filesystem::remove(file);
}

void sizes(benchmark::internal::Benchmark *b) {
  b->Arg(64)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond);
}

BENCHMARK(mesh_and_assembly)->Apply(sizes);
BENCHMARK(history_product)->Apply(sizes);
BENCHMARK(factorise_and_condense)->Apply(sizes);
BENCHMARK(reduce_and_expand)->Apply(sizes);
BENCHMARK(interface_newton)->Apply(sizes);
BENCHMARK(vtu_output)->Apply(sizes);

}  // namespace
}  // namespace tourmaline

int main(int argc, char **argv) {
  const tourmaline::run::Process process(1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
