#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

/// The processes (MPI ranks) of a run. Cells, and with them matrices and integrals, are shared out,
/// so that what a rank computes is its share of a sum; whether vectors over the body are, too,
/// `body::NodeSharing` knows. Functions that communicate must be called by all ranks. Without MPI,
/// or on one rank, all of this does nothing.
namespace tourmaline::parallel {

int rank();
int n_ranks();
inline bool is_first() {
  return rank() == 0;
}

/// Whether a launcher (mpirun) started this process.
bool is_launched();

/// Whether this process is the one that speaks to the user: the first rank, also while MPI does not
/// run, as far as the launcher tells.
bool speaks();

/// Each entry becomes its sum, or its largest value, over all ranks; the same bits on all.
void sum(std::span<double> values);
double sum(double value);
std::size_t sum(std::size_t value);
void largest(std::span<double> values);

/// All ranks get what the first one holds; what has a size of its own is resized.
void from_first(std::span<double> values);
void from_first(std::vector<double> &values);
void from_first(std::string &bytes);
void from_first(std::span<int> values);
int from_first(int value);

/// The lists of all ranks, one behind the other, on every rank.
std::vector<double> joined(const std::vector<double> &mine);
std::vector<std::uint32_t> joined(const std::vector<std::uint32_t> &mine);
/// The same on the first rank only; empty on the others.
std::vector<double> joined_on_first(const std::vector<double> &mine);
std::vector<std::uint32_t> joined_on_first(const std::vector<std::uint32_t> &mine);

/// What goes to another rank and what comes from there, each of a size that both know.
struct Message {
  int rank;
  std::vector<double> sent, received;
};
/// Two ranks have one message each for the other, or none.
void exchange(std::span<Message> messages);

/// Runs work that does not communicate. If it throws on some rank, all ranks throw the error of the
/// first of these, so that none waits for another.
void together(const std::function<void()> &work);
/// The same for work that only the first rank does.
void on_first(const std::function<void()> &work);

/// Whether all ranks call this within `patience` of each other. It disturbs none that is busy with
/// something else: for a rank that cannot know whether the others have its error as well.
bool all_come(std::chrono::milliseconds patience);

/// Ends all ranks at once, for errors that leave the others waiting.
[[noreturn]] void end_all(int exit_status);

}  // namespace tourmaline::parallel
