#include "condensation/pages.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>

#include "tourmaline/error.h"

namespace tourmaline::condensation {

Pages::Pages(std::size_t doubles) : size_(doubles) {
  if (size_ == 0)
    return;
  void *pages = mmap(nullptr, size_ * sizeof(double), PROT_READ | PROT_WRITE,
                     MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED)
    throw MachineError(fmt::format(
        "not enough memory for a factorisation: {:.3g} GiB in one piece are not to be had; use a "
        "coarser mesh",
        static_cast<double>(size_) * sizeof(double) / (1 << 30)));
  madvise(pages, size_ * sizeof(double), MADV_HUGEPAGE);
  data_ = static_cast<double *>(pages);
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
