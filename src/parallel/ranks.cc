#include "parallel/ranks.h"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <new>
#include <numeric>
#include <string>
#include <thread>

#include "tourmaline/error.h"

namespace tourmaline::parallel {

namespace {

bool mpi_runs() {
  int started = 0, finished = 0;
  MPI_Initialized(&started);
  MPI_Finalized(&finished);
  return started && !finished;
}

template <class Number>
std::vector<Number> gathered(const std::vector<Number> &mine, MPI_Datatype type, bool on_all) {
  if (n_ranks() == 1)
    return mine;
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(n_ranks()), offsets(n_ranks());
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
  std::vector<Number> all(on_all || is_first() ? offsets.back() + counts.back() : 0);
  if (on_all)
    MPI_Allgatherv(mine.data(), count, type, all.data(), counts.data(), offsets.data(), type,
                   MPI_COMM_WORLD);
  else
    MPI_Gatherv(mine.data(), count, type, all.data(), counts.data(), offsets.data(), type, 0,
                MPI_COMM_WORLD);
  return all;
}

// What went wrong on a rank, in a form that can be sent.
struct Failure {
  enum Kind { none, wrong_case, solve, unsettled_step, machine, other } kind = none;
  std::string text;
};

Failure failure_of(const std::function<void()> &work) {
  try {
    work();
    return {};
  } catch (const CaseError &error) {
    return {Failure::wrong_case, error.what()};
  } catch (const UnsettledStep &error) {
    return {Failure::unsettled_step, error.what()};
  } catch (const SolveError &error) {
    return {Failure::solve, error.what()};
  } catch (const MachineError &error) {
    return {Failure::machine, error.what()};
  } catch (const std::bad_alloc &) {
    return {Failure::machine, "not enough memory"};
  } catch (const std::exception &error) {
    return {Failure::other, error.what()};
  }
}

[[noreturn]] void raise(const Failure &failure) {
  switch (failure.kind) {
    case Failure::wrong_case:
      throw CaseError(failure.text);
    case Failure::solve:
      throw SolveError(failure.text);
    case Failure::unsettled_step:
      throw UnsettledStep(failure.text);
    case Failure::machine:
      throw MachineError(failure.text);
    default:
      throw std::runtime_error(failure.text);
  }
}

void send_from(int rank, Failure &failure) {
  std::array<int, 2> head{failure.kind, static_cast<int>(failure.text.size())};
  MPI_Bcast(head.data(), 2, MPI_INT, rank, MPI_COMM_WORLD);
  failure.kind = static_cast<Failure::Kind>(head[0]);
  failure.text.resize(head[1]);
  MPI_Bcast(failure.text.data(), head[1], MPI_CHAR, rank, MPI_COMM_WORLD);
}

}  // namespace

int rank() {
  int rank = 0;
  if (mpi_runs())
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

namespace {

const char *const launched_as = std::getenv("OMPI_COMM_WORLD_RANK");

}  // namespace

bool is_launched() {
  return launched_as != nullptr;
}

bool speaks() {
  return mpi_runs() ? is_first() : !launched_as || std::string(launched_as) == "0";
}

int n_ranks() {
  int ranks = 1;
  if (mpi_runs())
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

// Summed on one rank and sent from there: the order of the terms, and so the last bit, may differ
// between ranks otherwise.
void sum(std::span<double> values) {
  if (n_ranks() == 1)
    return;
  MPI_Reduce(is_first() ? MPI_IN_PLACE : values.data(), values.data(),
             static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
  from_first(values);
}

double sum(double value) {
  sum(std::span(&value, 1));
  return value;
}

std::size_t sum(std::size_t value) {
  if (n_ranks() > 1)
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_UNSIGNED_LONG, MPI_SUM, MPI_COMM_WORLD);
  return value;
}

void largest(std::span<double> values) {
  if (n_ranks() > 1)
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX,
                  MPI_COMM_WORLD);
}

void from_first(std::span<double> values) {
  if (n_ranks() > 1)
    MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
}

void from_first(std::vector<double> &values) {
  values.resize(from_first(static_cast<int>(values.size())));
  from_first(std::span<double>(values));
}

// Of any size: MPI counts in int.
void from_first(std::string &bytes) {
  if (n_ranks() == 1)
    return;
  std::size_t size = bytes.size();
  MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG, 0, MPI_COMM_WORLD);
  bytes.resize(size);
  constexpr std::size_t most = std::size_t{1} << 30;
  for (std::size_t at = 0; at < size; at += most)
    MPI_Bcast(bytes.data() + at, static_cast<int>(std::min(most, size - at)), MPI_CHAR, 0,
              MPI_COMM_WORLD);
}

void from_first(std::span<int> values) {
  if (n_ranks() > 1)
    MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_INT, 0, MPI_COMM_WORLD);
}

int from_first(int value) {
  from_first(std::span(&value, 1));
  return value;
}

std::vector<double> joined(const std::vector<double> &mine) {
  return gathered(mine, MPI_DOUBLE, true);
}

std::vector<std::uint32_t> joined(const std::vector<std::uint32_t> &mine) {
  return gathered(mine, MPI_UINT32_T, true);
}

std::vector<std::uint32_t> joined_on_first(const std::vector<std::uint32_t> &mine) {
  return gathered(mine, MPI_UINT32_T, false);
}

std::vector<double> joined_on_first(const std::vector<double> &mine) {
  return gathered(mine, MPI_DOUBLE, false);
}

void exchange(std::span<Message> messages) {
  constexpr int tag = 1;
  std::vector<MPI_Request> requests;
  for (Message &of : messages) {
    MPI_Irecv(of.received.data(), static_cast<int>(of.received.size()), MPI_DOUBLE, of.rank, tag,
              MPI_COMM_WORLD, &requests.emplace_back());
    MPI_Isend(of.sent.data(), static_cast<int>(of.sent.size()), MPI_DOUBLE, of.rank, tag,
              MPI_COMM_WORLD, &requests.emplace_back());
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

void together(const std::function<void()> &work) {
  if (n_ranks() == 1) {
    work();
    return;
  }
  Failure failure = failure_of(work);
  int first = failure.kind == Failure::none ? n_ranks() : rank();
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (first == n_ranks())
    return;
  send_from(first, failure);
  raise(failure);
}

void on_first(const std::function<void()> &work) {
  together([&] {
    if (is_first())
      work();
  });
}

bool all_come(std::chrono::milliseconds patience) {
  constexpr int tag = 32767;  // the largest that every MPI has; nothing else here sends to this tag
  std::vector<MPI_Request> requests;
  for (int other = 0; other < n_ranks(); ++other)
    if (other != rank()) {
      MPI_Isend(nullptr, 0, MPI_CHAR, other, tag, MPI_COMM_WORLD, &requests.emplace_back());
      MPI_Irecv(nullptr, 0, MPI_CHAR, other, tag, MPI_COMM_WORLD, &requests.emplace_back());
    }
  const auto end = std::chrono::steady_clock::now() + patience;
  int all = requests.empty();
  while (!all && std::chrono::steady_clock::now() < end) {
    MPI_Testall(static_cast<int>(requests.size()), requests.data(), &all, MPI_STATUSES_IGNORE);
    if (!all)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return all != 0;
}

void end_all(int exit_status) {
  if (n_ranks() > 1)
    MPI_Abort(MPI_COMM_WORLD, exit_status);
  std::exit(exit_status);
}

}  // namespace tourmaline::parallel
