// A program of somebody else's on the library, which leaves MPI to it:
//
//     own_program CASE DIR [OPTION]...
//
//     bound=S      with Tresca's law of this bound as a law of its own, named "borrowed, S N/m^2"
//     fault=KIND   of that law, and `from=TIME` [s] and `rank=R` where and when alone it has it
//     resume       goes on
//     twice        once more in the same process, into DIR/again
//     KEY=VALUE    changes the case
#include <mpi.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"
#include "tourmaline/mesh/gmsh.h"
#include "tourmaline/run/simulation.h"

namespace {

using namespace tourmaline;
using contact::Tangent;
using contact::TangentMatrix;

struct Asked {
  std::vector<std::string> overrides;
  std::string bound, fault;
  double from = 0;
  int rank = -1;  // all
  bool twice = false;
  run::Start start = run::Start::beginning;
};

class Borrowed : public contact::FrictionLaw {
 public:
  Borrowed(double bound, std::string fault) : law_{bound}, fault_(std::move(fault)) {}

  double dissipation(const Tangent &d) const override {
    return fault_ == "dissipation" ? -1 : law_.dissipation(d);
  }
  Tangent traction(const Tangent &trial) const override {
    if (fault_ == "throw")
      throw std::runtime_error("out of tables");
    if (fault_ == "throw-number")
      throw 42;
    if (fault_ == "kill")
      std::raise(SIGKILL);
    if (fault_ == "size")
      return Tangent::Zero(1);
    if (fault_ == "nan")
      return Tangent::Constant(trial.size(), std::numeric_limits<double>::quiet_NaN());
    return law_.traction(trial);
  }
  TangentMatrix traction_derivative(const Tangent &trial) const override {
    return law_.traction_derivative(trial);
  }
  ContactStatus status(const Tangent &trial) const override {
    return fault_ == "status" ? ContactStatus::stick : law_.status(trial);
  }
  bool is_smooth_at(const Tangent &d) const override { return law_.is_smooth_at(d); }
  Tangent gradient(const Tangent &d) const override { return law_.gradient(d); }
  TangentMatrix hessian(const Tangent &d) const override { return law_.hessian(d); }

 private:
  contact::Tresca law_;
  std::string fault_;
};

int rank_of_this() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

contact::FrictionAt laws(const Asked &asked) {
  return [asked](const contact::ContactPlace &place) -> contact::Friction {
    const bool is_wrong =
        place.time > asked.from && (asked.rank < 0 || asked.rank == rank_of_this());
    const std::string fault = is_wrong ? asked.fault : "";
    if (fault == "empty")
      return contact::OwnLaw{};
    if (fault == "endless")
      return contact::Tresca{std::numeric_limits<double>::infinity()};
    return contact::OwnLaw{std::make_shared<Borrowed>(std::stod(asked.bound), fault)};
  };
}

std::string value_of(const std::string &option, const std::string &name) {
  return option.starts_with(name) ? option.substr(name.size()) : "";
}

Asked read(int argc, char **argv) {
  Asked asked;
  for (int i = 3; i < argc; ++i) {
    const std::string option = argv[i];
    if (const auto bound = value_of(option, "bound="); !bound.empty())
      asked.bound = bound;
    else if (const auto fault = value_of(option, "fault="); !fault.empty())
      asked.fault = fault;
    else if (const auto from = value_of(option, "from="); !from.empty())
      asked.from = std::stod(from);
    else if (const auto rank = value_of(option, "rank="); !rank.empty())
      asked.rank = std::stoi(rank);
    else if (option == "resume")
      asked.start = run::Start::checkpoint;
    else if (option == "twice")
      asked.twice = true;
    else
      asked.overrides.push_back(option);
  }
  return asked;
}

void simulate(const Asked &asked, const std::string &file, const std::string &directory) {
  run::RunOptions options{.quiet = true, .start = asked.start};
  if (!asked.bound.empty()) {
    options.friction = laws(asked);
    options.friction_name = "borrowed, " + asked.bound + " N/m^2";
  }
  const auto read = casefile::read_file(file, asked.overrides, mesh::read_mesh_file);
  run::simulate(read, directory, options);
  if (asked.twice)
    run::simulate(read, directory + "/again", options);
}

}  // namespace

int main(int argc, char **argv) {
  try {
    simulate(read(argc, argv), argv[1], argv[2]);
  } catch (const CaseError &error) {
    std::cerr << "own_program: " << error.what() << '\n';
    return 2;
  } catch (const SolveError &error) {
    std::cerr << "own_program: " << error.what() << '\n';
    return 3;
  } catch (const Error &error) {
    std::cerr << "own_program: " << error.what() << '\n';
    return 4;
  }
}
