#include "solver/bench/result.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/version.hpp"
#include "solver/physics/pack.hpp"

namespace mpfem {

namespace {

/// Work over the time that it took.
struct Rate {
  Rate(const Work& work, double nanoseconds)
      : bytes(work.bytes / nanoseconds), operations(work.operations / nanoseconds) {}
  double bytes;      ///< GB/s
  double operations; ///< GFlop/s
};

Rate element_rate(const BenchResult& r) {
  return {r.tet, r.elements.nanoseconds};
}
Rate contact_rate(const BenchResult& r) {
  return {r.contact, r.scene.tets * r.step.of(Part::contact)};
}
Rate search_rate(const BenchResult& r) {
  return {r.search_work, 1e9 * r.search.seconds};
}
Rate integration_rate(const BenchResult& r) {
  return {r.integration, r.scene.tets * r.step.of(Part::integration)};
}

double checkpoint_speed(const BenchResult& r) { // GB/s
  return 1e-9 * r.output.checkpoint_bytes / r.output.checkpoint_seconds;
}

using Field = std::pair<std::string, std::string>;
using Fields = std::vector<Field>;

Field text(const char* name, std::string_view value) {
  return {name, fmt::format("\"{}\"", value)};
}
Field number(const std::string& name, double value) {
  return {name, fmt::format("{:.6g}", value)};
}
template <class Integer>
Field integer(const char* name, Integer value) {
  return {name, std::to_string(value)};
}

void add_rate(Fields& fields, const std::string& part, const Rate& rate) {
  fields.push_back(number(part + "_GB_per_s", rate.bytes));
  fields.push_back(number(part + "_GFlop_per_s", rate.operations));
}

Fields scene_fields(const BenchScene& s) {
  return {text("version", version()),
          text("element", s.element),
          integer("ranks", s.ranks),
          integer("threads", s.threads),
          text("precision", s.precision),
          integer("lanes", s.lanes),
          integer("tets", s.tets),
          integer("grains", s.grains),
          number("relative_density", s.relative_density),
          number("bonds", s.bonds),
          number("contact_points", s.contact_points),
          integer("candidate_points", s.candidate_points),
          integer("steps", s.steps)};
}

/// Searches are not among them: their cost is that of one search over the steps that it lasts.
void add_step_fields(Fields& fields, const StepCost& step) {
  const auto add = [&](const std::string& name, double cost) {
    fields.push_back(number(name + "_ns_per_tet_step", cost));
  };
  add("elements", step.of(Part::elements));
  add("contact", step.of(Part::contact));
  add("integration", step.of(Part::integration));
  add("surface", step.of(Part::surface));
  add("step_estimate", step.of(Part::step_estimate));
  add("whole_step", step.whole);
}

void add_element_fields(Fields& fields, const BenchResult& r) {
  fields.push_back(number("element_pass_ns_per_tet_step", r.elements.nanoseconds));
  fields.push_back(number("element_pass_hardening_fraction", r.elements.hardening));
  add_rate(fields, "element_pass", element_rate(r));
  fields.push_back(number("flop_per_tet_step", r.tet.operations));
  fields.push_back(number("bytes_per_tet_step", r.tet.bytes));
}

void add_contact_fields(Fields& fields, const BenchResult& r) {
  const double contact = r.step.of(Part::contact), search = r.search_per_step();
  fields.push_back(number("contact_ns_per_point", r.per_point(contact)));
  if (!r.alone()) return;
  add_rate(fields, "contact", contact_rate(r));
  fields.push_back(number("search_ns_per_tet_step", search));
  fields.push_back(number("search_ns_per_point_step", r.per_point(search)));
  add_rate(fields, "search", search_rate(r));
  fields.push_back(number("search_ms", 1e3 * r.search.seconds));
  fields.push_back(number("steps_per_search", r.search.steps));
}

void add_rest_fields(Fields& fields, const BenchResult& r) {
  add_rate(fields, "integration", integration_rate(r));
  fields.push_back(number("output_ns_per_tet_step", r.output_per_step()));
  fields.push_back(number("history_row_ns_per_tet", r.per_tet(r.output.row_seconds)));
  fields.push_back(number("checkpoint_ns_per_tet", r.per_tet(r.output.checkpoint_seconds)));
  fields.push_back(number("checkpoint_GB_per_s", checkpoint_speed(r)));
  fields.push_back(number("checkpoint_bytes_per_tet", r.output.checkpoint_bytes / r.scene.tets));
  fields.push_back(number("memory_bytes_per_tet", r.memory / r.scene.tets));
  fields.push_back(number("triad_GB_per_s", r.machine.triad));
  fields.push_back(number("fma_GFlop_per_s", r.machine.fma));
}

void add_fields_of_ranks(Fields& fields, const BenchResult& r) {
  fields.push_back(number("sent_bytes_per_step", r.ranks.sent));
  fields.push_back(number("message_wait_ns_per_tet_step", r.ranks.waited_for_messages));
  fields.push_back(number("sum_wait_ns_per_tet_step", r.ranks.waited_in_sums));
  fields.push_back(number("least_sum_wait_ns_per_tet_step", r.ranks.waited_in_sums_least));
  fields.push_back(number("imbalance", r.ranks.imbalance));
  fields.push_back(number("memory_bytes_of_first_rank", r.memory_of_root));
}

std::string ranks_text(const BenchResult& r) {
  return fmt::format(
      "ranks          {} of them, {:.2f} GB at most in the first; {:.1f} kB of messages per step from the "
      "one that sends most\n",
      r.scene.ranks, 1e-9 * r.memory_of_root, 1e-3 * r.ranks.sent);
}

std::string scene_text(const BenchResult& r) {
  const BenchScene& s = r.scene;
  return fmt::format("machine        {} threads, vectors of {} doubles: memory {:.1f} GB/s (triad), arithmetic {:.1f} "
                     "GFlop/s\n",
                     s.ranks * s.threads, native_lanes, r.machine.triad, r.machine.fma) +
         (r.alone() ? "" : ranks_text(r)) +
         fmt::format("scene          {} {} tetrahedra ({} precision, vectors of {}) in {} grains, relative density "
                     "{:.3f}, {:.0f} contact points in touch out of {} found by the search, {:.0f} bonds\n",
                     s.tets, s.element, s.precision, s.lanes, s.grains, s.relative_density, s.contact_points,
                     s.candidate_points, s.bonds) +
         fmt::format("memory         {:.0f} bytes per tetrahedron, {:.2f} GB at most in total\n\n", r.memory / s.tets,
                     1e-9 * r.memory) +
         fmt::format(
             "element forces alone, {:.0f} % of the tetrahedra yielding: {:.2f} ns per tet-step (one tetrahedron, one "
             "step)\n\n",
             100 * r.elements.hardening, r.elements.nanoseconds);
}

std::string cost_text(const BenchResult& r) {
  std::string table = fmt::format("{:<28} {:>15} {:>8} {:>26}\n", "part of a step", "ns per tet-step", "share",
                                  "ns per contact point, step");
  const auto line = [&](const char* name, double value, bool per_point) {
    table += fmt::format("{:<28} {:>15.2f} {:>7.1f}% {:>26}\n", name, value, 100 * value / r.step.whole,
                         per_point && r.scene.contact_points > 0 ? fmt::format("{:.1f}", r.per_point(value)) : "");
  };
  double accounted = 0;
  for (const Part p :
       {Part::elements, Part::contact, Part::contact_search, Part::integration, Part::surface, Part::step_estimate}) {
    line(part_names[static_cast<std::size_t>(p)], r.step.of(p), p == Part::contact);
    accounted += r.step.of(p);
  }
  line("waiting and rest", r.step.whole - accounted, false);
  line("total", r.step.whole, false);
  if (r.search.steps > 0) line("one search, per step", r.search_per_step(), true);
  line("output, per step", r.output_per_step(), false);
  return table;
}

std::string rate_text(const BenchResult& r) {
  std::string table = fmt::format("\n{:<28} {:>12} {:>13} {:>10} {:>18}\n", "lower bound of the work", "memory, GB/s",
                                  "of machine's", "GFlop/s", "of machine's");
  const auto line = [&](const char* name, const Rate& rate) {
    table += fmt::format("{:<28} {:>12.1f} {:>11.0f} % {:>10.1f} {:>16.1f} %\n", name, rate.bytes,
                         100 * rate.bytes / r.machine.triad, rate.operations, 100 * rate.operations / r.machine.fma);
  };
  line("element forces alone", element_rate(r));
  if (r.alone()) {
    line("contact forces", contact_rate(r));
    line("contact search", search_rate(r));
  }
  line("integration", integration_rate(r));
  table += fmt::format("per tetrahedron: {:.0f} bytes, {:.0f} operations", r.tet.bytes, r.tet.operations);
  const double points = r.scene.contact_points;
  if (r.alone())
    table += fmt::format("; per contact point with its bond and the open points near it: {:.0f} bytes, {:.0f} "
                         "operations for its penalty force",
                         points > 0 ? r.contact.bytes / points : 0.0, points > 0 ? r.contact.operations / points : 0.0);
  return table + "\n\n";
}

} // namespace

double BenchResult::search_per_step() const {
  return per_tet(search.seconds) / std::max(search.steps, 1.0);
}

double BenchResult::output_per_step() const {
  return per_tet(output.row_seconds) / std::max(output.steps_per_row, 1.0) +
         step.whole * output.checkpoint_seconds / std::max(output.checkpoint_interval, 1.0);
}

std::string json_text(const BenchResult& result) {
  Fields fields = scene_fields(result.scene);
  add_step_fields(fields, result.step);
  add_element_fields(fields, result);
  add_contact_fields(fields, result);
  add_rest_fields(fields, result);
  if (!result.alone()) add_fields_of_ranks(fields, result);
  std::string object = "{";
  for (std::size_t i = 0; i < fields.size(); ++i)
    object += fmt::format("{}\n  \"{}\": {}", i > 0 ? "," : "", fields[i].first, fields[i].second);
  return object + "\n}\n";
}

std::string table_text(const BenchResult& r) {
  const std::string search = r.alone() ? fmt::format("contact search {:.2f} ms, valid for {:.0f} steps; ",
                                                     1e3 * r.search.seconds, r.search.steps)
                                       : "";
  return scene_text(r) + cost_text(r) + rate_text(r) + search +
         fmt::format("history row {:.2f} ms; checkpoint {:.2f} s, {:.0f} bytes per tetrahedron, {:.2f} GB/s\n",
                     1e3 * r.output.row_seconds, r.output.checkpoint_seconds, r.output.checkpoint_bytes / r.scene.tets,
                     checkpoint_speed(r));
}

} // namespace mpfem
