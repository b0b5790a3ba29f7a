#include "solve/force_size.h"

#include "larger.h"

namespace tourmaline::solve {

using Eigen::VectorXd;

namespace {

// NaN where an entry is.
double largest_of(const VectorXd &v) {
  return v.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

double size_of_rows(const InterfaceProgramme &programme, const VectorXd &d, const FieldRows &rows) {
  const auto of = Eigen::seqN(rows.begin, rows.size);
  const double size =
      larger(larger(rows.scale, largest_of(programme.force(of))),
             largest_of(sizes_of_terms(programme.stiffness, d, rows.begin, rows.size)));
  return size == 0 ? 1 : size;
}

}  // namespace

double size_of_forces(const InterfaceProgramme &programme, const VectorXd &d) {
  if (!programme.fields.empty() && programme.n_forces() > 0)
    return size_of_rows(programme, d, {0, programme.n_forces(), programme.force_scale});
  double size = programme.force_scale;
  if (d.size() > 0)
    size = larger(larger(size, largest_of(programme.force)),
                  largest_of(sizes_of_terms(programme.stiffness, d)));
  return size == 0 ? 1 : size;
}

double size_of_flows(const InterfaceProgramme &programme, const VectorXd &d, std::size_t field) {
  return size_of_rows(programme, d, programme.fields[field]);
}

double ForceSize::at(const VectorXd &d) {
  if (!is_large(d.size()))
    return size_of_forces(programme_, d);
  if (!last_ || last_->d != d)
    last_ = {d, size_of_forces(programme_, d)};
  return last_->size;
}

// No entry of A is larger than the largest of its diagonal.
bool ForceSize::exceeds_all(const VectorXd &d, double residual, double tolerance) const {
  if (d.size() == 0 || !programme_.fields.empty())
    return false;
  const double at_most = larger(programme_.force_scale, largest_of(programme_.force)) +
                         largest_of(programme_.stiffness.diagonal()) * d.lpNorm<1>();
  return at_most > 0 && residual > tolerance * at_most;
}

bool ForceSize::is_within(const VectorXd &d, double residual, double tolerance) {
  if (exceeds_all(d, residual, tolerance) || (last_ && residual > tolerance * last_->size))
    return false;
  return relative_to(residual, at(d)) <= tolerance;
}

}  // namespace tourmaline::solve
