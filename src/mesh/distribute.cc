#include "mesh/distribute.h"

#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include "parallel/ranks.h"

namespace tourmaline::mesh {

template <int dim>
void distribute(Mesh<dim> &mesh) {
  if (parallel::n_ranks() == 1)
    return;
  dealii::GridTools::partition_triangulation(parallel::n_ranks(), *mesh.cells);
  const auto share =
      dealii::TriangulationDescription::Utilities::create_description_from_triangulation(
          *mesh.cells, MPI_COMM_WORLD);
  auto cells =
      std::make_unique<dealii::parallel::fullydistributed::Triangulation<dim>>(MPI_COMM_WORLD);
  cells->create_triangulation(share);
  mesh.cells = std::move(cells);
}

template void distribute<2>(Mesh<2> &);
template void distribute<3>(Mesh<3> &);

}  // namespace tourmaline::mesh
