#include "condensation/pages.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <fstream>

#include "tourmaline/error.h"

namespace tourmaline::condensation {

namespace {

constexpr std::size_t a_task = std::size_t{16} << 20;  // bytes

// A virtual machine may give free blocks of 2^order pages and larger ones back to its host, which
// has to find them anew when they are used. Smaller pieces it has kept (docs/factorisation.md).
bool gives_huge_pages_back() {
  constexpr unsigned of_huge_pages = 9;
  std::ifstream file("/sys/module/page_reporting/parameters/page_reporting_order");
  unsigned order = 0;
  return file >> order && order <= of_huge_pages;
}

}  // namespace

Pages::Pages(std::size_t doubles) {
  parallel::Team alone(1);
  *this = Pages(doubles, alone);
}

Pages::Pages(std::size_t doubles, parallel::Team &team) : size_(doubles) {
  if (size_ == 0)
    return;
  void *pages = mmap(nullptr, size_ * sizeof(double), PROT_READ | PROT_WRITE,
                     MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED)
    throw MachineError(fmt::format(
        "not enough memory for a factorisation: {:.3g} GiB in one piece are not to be had; use a "
        "coarser mesh",
        static_cast<double>(size_) * sizeof(double) / (1 << 30)));
  static const bool takes_small_ones = gives_huge_pages_back();
  data_ = static_cast<double *>(pages);
  const std::size_t bytes = size_ * sizeof(double);
  if (!takes_small_ones)
    madvise(data_, bytes, MADV_HUGEPAGE);
  else
    team.share_out(static_cast<int>((bytes + a_task - 1) / a_task), [&](int task, int) {
      const std::size_t begin = task * a_task;
      madvise(reinterpret_cast<char *>(data_) + begin, std::min(a_task, bytes - begin),
              MADV_POPULATE_WRITE);
    });
}

Pages::~Pages() {
  if (data_ != nullptr)
    munmap(data_, size_ * sizeof(double));
}

double *Stack::push(std::size_t doubles) {
  double *begin = pages_.data() + used_;
  used_ += doubles;
  if (touched_ > used_ - doubles)  // what lies beyond has never been used
    std::fill(begin, begin + std::min(doubles, touched_ - (used_ - doubles)), 0.);
  touched_ = std::max(touched_, used_);
  return begin;
}

}  // namespace tourmaline::condensation
