#pragma once

#include <functional>

namespace tourmaline::solve {

/// A way to the solution of a step with contact that opens: springs between body and foundation
/// (`contact::YosidaNormal`), ever stiffer ones. Among soft ones the body bends as it would alone,
/// and each solution is near enough to the next; a slender body whose points are let go and closed
/// one by one has no such way.
///
/// `solve` takes the step with springs of a stiffness, over the body's own at the point, from where
/// it was solved last; whether it could. Whether the way has led to the end.
bool follow_springs(const std::function<bool(double stiffness)> &solve);

}  // namespace tourmaline::solve
