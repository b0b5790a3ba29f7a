#pragma once

#include <functional>
#include <limits>
#include <string>

namespace tourmaline::mesh {

/// What a child process may take; infinite: any.
struct Limits {
  double processor_seconds = std::numeric_limits<double>::infinity();
  double seconds = std::numeric_limits<double>::infinity();  ///< by the clock
  /// without any work of a processor: it waits for what does not come
  double idle_seconds = std::numeric_limits<double>::infinity();
  double bytes = std::numeric_limits<double>::infinity();  ///< of memory, beyond this process's
};

/// How a child process ended that did not finish its work.
enum class Ending { crashed, out_of_time, out_of_memory, forbidden, silent, waiting };

/// Runs `work` in a child of this process and returns what it returned there, so that a library
/// that crashes or does not end takes nothing along. CaseError and MachineError come back as such;
/// of a child that ends otherwise, or takes more than the limits, `complaint(ending)` becomes a
/// CaseError. What it prints is lost. It has no open files of this process, and ends with it.
std::string in_child_process(const std::function<std::string()> &work, const Limits &limits,
                             const std::function<std::string(Ending)> &complaint);

}  // namespace tourmaline::mesh
