#include "mesh/distribute.h"

#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "parallel/ranks.h"

namespace tourmaline::mesh {

namespace {

// Of the whole mesh: so many ranks that follow each other are mostly on one machine.
constexpr int ranks_of_a_group = 32;

template <int dim>
std::unique_ptr<dealii::Triangulation<dim>> shares_of(
    std::unique_ptr<dealii::Triangulation<dim>> made) {
  const auto share =
      dealii::TriangulationDescription::Utilities::create_description_from_triangulation_in_groups<
          dim, dim>(
          [&made](dealii::Triangulation<dim> &whole) {
            whole = std::move(*made);
            made.reset();
          },
          [](dealii::Triangulation<dim> &whole, const MPI_Comm &, unsigned int) {
            dealii::GridTools::partition_triangulation(parallel::n_ranks(), whole);
          },
          MPI_COMM_WORLD, ranks_of_a_group);
  auto cells =
      std::make_unique<dealii::parallel::fullydistributed::Triangulation<dim>>(MPI_COMM_WORLD);
  cells->create_triangulation(share);
  return cells;
}

// Of the first rank.
template <int dim>
void share_names(Mesh<dim> &mesh) {
  std::string bytes;
  if (parallel::is_first())
    nlohmann::json::to_msgpack({mesh.boundaries, mesh.inner, mesh.simplices}, bytes);
  parallel::from_first(bytes);
  const auto names = nlohmann::json::from_msgpack(bytes);
  names[0].get_to(mesh.boundaries);
  names[1].get_to(mesh.inner);
  names[2].get_to(mesh.simplices);
}

}  // namespace

template <int dim>
Mesh<dim> shared_out(const std::function<Mesh<dim>()> &make) {
  Mesh<dim> mesh;
  parallel::together([&] {
    if (parallel::rank() % ranks_of_a_group == 0)
      mesh = make();
  });
  if (parallel::n_ranks() == 1)
    return mesh;
  mesh.cells = shares_of<dim>(std::move(mesh.cells));
  share_names(mesh);
  return mesh;
}

template Mesh<2> shared_out<2>(const std::function<Mesh<2>()> &);
template Mesh<3> shared_out<3>(const std::function<Mesh<3>()> &);

}  // namespace tourmaline::mesh
