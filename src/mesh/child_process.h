#pragma once

#include <functional>
#include <string>

namespace tourmaline::mesh {

/// Runs `work` in a child of this process and returns what it returned there, so that a library
/// that crashes or does not end takes nothing along. CaseError and MachineError come back as such;
/// a child that ends otherwise, or works for more than `most_seconds` of a processor (infinite:
/// any), is a CaseError. What it prints is lost.
std::string in_child_process(const std::function<std::string()> &work, double most_seconds);

}  // namespace tourmaline::mesh
