#include "mesh/mesh.h"
#include "mesh/shapes.h"

namespace tourmaline::mesh {

template <int dim>
Mesh<dim> build(const casefile::MeshCase &asked) {
  if (asked.annulus)
    return annulus<dim>(*asked.annulus);
  if (asked.content)
    return imported<dim>(*asked.content);
  return box<dim>(*asked.box);
}

template Mesh<2> build<2>(const casefile::MeshCase &);
template Mesh<3> build<3>(const casefile::MeshCase &);

}  // namespace tourmaline::mesh
