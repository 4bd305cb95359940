#pragma once
// Totals over all grains of all ranks. Sums are exact (exact_sum.hpp), so a rank adds up its own grains and one message
// of a few kilobytes, whatever the number of grains, brings the ranks' sums together.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/exact_sum.hpp"
#include "solver/parallel/communicator.hpp"

namespace mpfem {

/// The totals of `count` things, each a `Sums`. Sums::for_each_term(sums, visit) says which of its fields are added up,
/// and of which the largest counts. It calls visit.sum(double), visit.count(std::int64_t), visit.largest(double, at
/// least 0) or visit.every(bool) for each.
template <class Sums>
class Totals {
public:
  explicit Totals(std::size_t count = 1) {
    Sums none{};
    Sums::for_each_term(none, width_);
    sum_.resize(count * width_.sums);
    largest_.resize(count * width_.maxima + 1, 0.0); // the last: whether a rank has failed
  }

  /// Adds one grain's part to thing `index`.
  void add(const Sums& of_grain, std::size_t index = 0) {
    Sums::for_each_term(of_grain, Adding{sum_.data() + index * width_.sums, largest_.data() + index * width_.maxima});
  }
  /// Collective. Adds what the other ranks have. Returns whether any rank has `failed`.
  bool combine(const Communicator& ranks, bool failed = false) {
    largest_.back() = failed ? 1 : 0;
    if (!ranks.alone()) {
      std::vector<std::int64_t> words;
      for (ExactSum& sum : sum_) words.insert(words.end(), sum.data().begin(), sum.data().end());
      ranks.combine(words, largest_);
      auto from = words.begin();
      for (ExactSum& sum : sum_)
        for (std::int64_t& word : sum.data()) word = *from++;
    }
    return largest_.back() > 0;
  }
  Sums operator[](std::size_t index) const {
    Sums total{};
    Sums::for_each_term(total, Reading{sum_.data() + index * width_.sums, largest_.data() + index * width_.maxima});
    return total;
  }

private:
  struct Width {
    std::size_t sums = 0, maxima = 0;
    void sum(double) { ++sums; }
    void count(std::int64_t) { ++sums; }
    void largest(double) { ++maxima; }
    void every(bool) { ++maxima; }
  };
  struct Adding {
    ExactSum* next_sum;
    double* next_largest;
    void sum(double term) { (next_sum++)->add(term); }
    void count(std::int64_t number) { sum(static_cast<double>(number)); }
    void largest(double value) {
      *next_largest = std::max(*next_largest, value);
      ++next_largest;
    }
    void every(bool holds) { largest(holds ? 0 : 1); }
  };
  struct Reading {
    const ExactSum* next_sum;
    const double* next_largest;
    void sum(double& total) { total = (next_sum++)->value(); }
    void count(std::int64_t& total) { total = static_cast<std::int64_t>((next_sum++)->value()); }
    void largest(double& total) { total = *next_largest++; }
    void every(bool& all) { all = *next_largest++ == 0; }
  };

  Width width_;
  std::vector<ExactSum> sum_;
  std::vector<double> largest_;
};

/// Adds the terms of `other` to those of `sums`, one by one in plain doubles.
template <class Sums>
void add_terms(Sums& sums, const Sums& other) {
  struct Reading {
    double* next;
    void sum(double term) { *next++ = term; }
    void count(std::int64_t number) { sum(static_cast<double>(number)); }
    void largest(double value) { sum(value); }
    void every(bool holds) { sum(holds ? 1 : 0); }
  };
  struct Adding {
    const double* next;
    void sum(double& total) { total += *next++; }
    void count(std::int64_t& total) { total += static_cast<std::int64_t>(*next++); }
    void largest(double& total) { total = std::max(total, *next++); }
    void every(bool& all) { all = *next++ != 0 && all; }
  };
  std::array<double, sizeof(Sums)> term; // room for all: each term is at least one byte of Sums
  Sums::for_each_term(other, Reading{term.data()});
  Sums::for_each_term(sums, Adding{term.data()});
}

/// Collective. The total over all grains. `of_grain` ([grains]) is set for own grains.
template <class Sums>
Sums total_of(const Communicator& ranks, std::span<const std::int32_t> own, std::span<const Sums> of_grain) {
  Totals<Sums> totals;
  for (const std::int32_t grain : own) totals.add(of_grain[static_cast<std::size_t>(grain)]);
  totals.combine(ranks);
  return totals[0];
}

/// A single term, for sum_over_grains().
struct OneNumber {
  double value = 0;

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    visit.sum(s.value);
  }
};

/// Collective. The sum of one number of every grain. `of_grain(grain)` is called for own grains.
template <class OfGrain>
double sum_over_grains(const Communicator& ranks, std::span<const std::int32_t> own, OfGrain&& of_grain) {
  Totals<OneNumber> totals;
  for (const std::int32_t grain : own) totals.add({of_grain(grain)});
  totals.combine(ranks);
  return totals[0].value;
}

} // namespace mpfem
