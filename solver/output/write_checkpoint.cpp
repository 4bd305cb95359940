#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/index.hpp"
#include "solver/model/tets.hpp"
#include "solver/output/bond_laws.hpp"
#include "solver/output/checkpoint.hpp"
#include "solver/output/checkpoint_datasets.hpp"
#include "solver/output/gathered_file.hpp"
#include "solver/output/history.hpp"
#include "solver/output/numbering_hash.hpp"

namespace mpfem {

namespace {

using namespace checkpoint_datasets;
using Index = std::int32_t;
using Counts = std::vector<std::int64_t>; ///< [grains]

template <class Dataset, class Vector>
void write_all(schema::FileWriter& file, const Dataset& dataset, const Vector& values, std::size_t rows) {
  file.write(dataset, std::span<const typename Vector::value_type>(values), rows);
}
template <class Dataset, class Vector>
void write_all(schema::FileWriter& file, const Dataset& dataset, const Vector& values) {
  write_all(file, dataset, values, values.size());
}

void write_record(schema::FileWriter& file, const RunRecord& record) {
  std::vector<std::string> stage_name, stage_end;
  std::vector<double> stage_values, hold_root_mean_square;
  for (const StageResult& stage : record.stages) {
    stage_name.push_back(stage.name);
    stage_end.push_back(stage.ended_by);
    stage_values.insert(stage_values.end(), {stage.overshoot, stage.hold_error, stage.hold_stress});
    hold_root_mean_square.push_back(stage.hold_root_mean_square);
  }
  write_all(file, check::run_snapshots, record.snapshot_files);
  write_all(file, check::run_stage_name, stage_name);
  write_all(file, check::run_stage_end, stage_end);
  write_all(file, check::run_stage_values, stage_values, stage_name.size());
  write_all(file, check::run_stage_hold_rms, hold_root_mean_square);
  write_all(file, check::run_history, flatten(record.history));
  if (!record.tool_history.empty()) write_all(file, check::run_tool_history, flatten(record.tool_history));
  if (!record.from.empty()) file.write_scalar(check::run_from, record.from);
}

void write_fields(schema::FileWriter& file, const FieldValues& fields) {
  write_all(file, check::run_field_names, fields.name);
  write_all(file, check::run_integers, fields.integer);
  write_all(file, check::run_numbers, fields.number);
}

/// Writes what identifies the run and the build that made the arrays.
void write_identity(GatheredFile& file, const Model& model, const std::string& scenario_text) {
  const std::string numbering = hash_text(numbering_hash(file.ranks(), model));
  file.at_root([&](schema::FileWriter& writer) {
    writer.write_scalar(check::scenario, scenario_text);
    writer.write_scalar(check::packing_hash, hash_text(model.mesh_hash));
    writer.write_scalar(check::numbering_hash, numbering);
    writer.write_scalar(check::smooth_grains, Index{model.smooth_grains});
    writer.write_scalar(check::lanes, Index{native_lanes});
  });
}

void write_nodes(GatheredFile& file, const Model& model, const GrainSteps& steps) {
  const Counts nodes = rows_of_grains(model.node_offset);
  const auto copy = [&](const auto& array, std::size_t columns) {
    return [&array, columns, &model](Index grain, auto values) {
      std::copy_n(array.begin() + static_cast<std::ptrdiff_t>(columns * model.first_node(grain)), values.size(),
                  values.begin());
    };
  };
  for_each_node_array(
      model, [&](const auto& dataset, const auto& array) { file.write_grains(dataset, nodes, copy(array, 4)); });
  file.write_grains(check::node_step_contact, nodes, copy(steps.contact, 1));
}

void write_tets(GatheredFile& file, const Model& model) {
  const Counts tets = rows_of_grains(model.tet_offset);
  for_each_tet_array([&](const auto& dataset, const auto& place) {
    file.write_grains(dataset, tets, [&](Index grain, std::span<double> values) {
      const Index first = model.tet_offset[at(grain)];
      for_tets_of(model, grain, first, model.tet_offset[at(grain) + 1],
                  [&](const auto& block, int lane, std::size_t tet) { values[tet - at(first)] = place(block)[lane]; });
    });
  });
}

void write_grain_numbers(GatheredFile& file, const CheckpointState& state) {
  const Counts one(at(state.model.grains), 1);
  for_each_grain_array(state.grain_steps, state.contact, [&](const auto& dataset, const std::vector<double>& array) {
    file.write_grains(dataset, one, [&](Index grain, std::span<double> values) { values[0] = array[at(grain)]; });
  });
}

/// Where the contacts of a grain's nodes begin in the rank's arrays.
struct ContactPlace {
  Index pair, point, facet;
};
ContactPlace first_of(const ContactCandidates& candidates, Index grain) {
  const Index pair = candidates.outgoing_offset[at(grain)], point = candidates.pair_point_offset[at(pair)];
  return {pair, point, candidates.point_facet_offset[at(point)]};
}

/// Number of contacts of the nodes of each grain, whoever owns the grain.
struct ContactCounts {
  Counts pairs, points, facets;
};

ContactCounts contact_counts(const Communicator& ranks, const Model& model, const ContactCandidates& candidates) {
  const auto count = [&](Index ContactPlace::*member) {
    return count_of_grains(ranks, model, [&](Index grain) {
      return first_of(candidates, grain + 1).*member - first_of(candidates, grain).*member;
    });
  };
  return {count(&ContactPlace::pair), count(&ContactPlace::point), count(&ContactPlace::facet)};
}

/// Sums of the counts before each grain, and of all.
Counts running_sums(const Counts& counts) {
  Counts sums{0};
  for (const std::int64_t count : counts) sums.push_back(sums.back() + count);
  if (sums.back() > std::numeric_limits<Index>::max())
    throw StorageError(fmt::format("a checkpoint cannot hold the {} contacts of so many grains, allowed: up to {}",
                                   sums.back(), std::numeric_limits<Index>::max()));
  return sums;
}

/// Writes the contacts between grains: for each pair, the data of the owner of its first grain.
class ContactWriter {
public:
  ContactWriter(GatheredFile& file, const Model& model, const Contact& contact)
      : file_(file), model_(model), contact_(contact), candidates_(contact.candidates),
        counts_(contact_counts(file.ranks(), model, contact.candidates)) {}

  void write_candidates() {
    for_each_pair_array(contact_, [&](const auto& dataset, const auto& array) {
      write_array(dataset, counts_.pairs, array, &ContactPlace::pair);
    });
    for_each_point_array(contact_, [&](const auto& dataset, const auto& array) {
      write_array(dataset, counts_.points, array, &ContactPlace::point);
    });
    write_array(check::contact_candidate_facet, counts_.facets, candidates_.point_facet, &ContactPlace::facet);
    write_offsets(check::contact_pair_point_offset, counts_.pairs, counts_.points, candidates_.pair_point_offset,
                  &ContactPlace::pair, &ContactPlace::point);
    write_offsets(check::contact_point_facet_offset, counts_.points, counts_.facets, candidates_.point_facet_offset,
                  &ContactPlace::point, &ContactPlace::facet);
  }

  void write_bonds() {
    write_member(check::bond_facet, contact_.bond, &PointBond::facet);
    write_rows(check::bond_values, contact_.bond);
    file_.write(check::bond_laws, flatten(contact_.bond_laws), contact_.bond_laws.size());
    if (contact_.bond_laws.size() > 1) write_member(check::bond_law, contact_.bond, &PointBond::law);
  }

  void write_friction() {
    write_member(check::friction_facet, contact_.point_friction, &PointFriction::facet);
    write_rows(check::friction_values, contact_.point_friction);
    write_friction_left_behind();
  }

private:
  /// Writes each grain's part of an array of pairs, points or facets.
  template <class T>
  void write_array(const schema::Dataset<T, 1>& dataset, const Counts& counts, const std::vector<T>& array,
                   Index ContactPlace::*member) {
    file_.write_grains(dataset, counts, [&](Index grain, std::span<T> values) {
      std::copy_n(array.begin() + first_of(candidates_, grain).*member, values.size(), values.begin());
    });
  }
  /// Calls set(k, point) for the points of a grain, k counted from its first.
  template <class Array, class Set>
  void for_points(const Array& array, Index grain, Set&& set) const {
    const std::size_t first = at(first_of(candidates_, grain).point), end = at(first_of(candidates_, grain + 1).point);
    for (std::size_t i = first; i < end; ++i) set(i - first, array[i]);
  }
  template <class Array, class Member>
  void write_member(const schema::Dataset<Index, 1>& dataset, const Array& array, Member member) {
    file_.write_grains(dataset, counts_.points, [&](Index grain, std::span<Index> values) {
      for_points(array, grain, [&](std::size_t k, const auto& point) { values[k] = point.*member; });
    });
  }
  template <class Array>
  void write_rows(const schema::Dataset<double, 2>& dataset, const Array& array) {
    file_.write_grains(dataset, counts_.points, [&](Index grain, std::span<double> values) {
      for_points(array, grain, [&](std::size_t k, const auto& point) {
        const auto row = row_of(point);
        std::ranges::copy(row, values.subspan(k * row.size()).begin());
      });
    });
  }
  /// Writes what pairs dissipated at points that they no longer have, by the grain of the nodes.
  void write_friction_left_behind() {
    const auto& lost = contact_.friction_of_former_points;
    const auto first_of_grain = [&](Index grain) { return lost.lower_bound({grain, 0}); };
    const Counts counts = count_of_grains(file_.ranks(), model_, [&](Index grain) {
      return std::distance(first_of_grain(grain), first_of_grain(grain + 1));
    });
    file_.write_grains(check::friction_left_grains, counts, [&](Index grain, std::span<Index> values) {
      auto entry = first_of_grain(grain);
      for (std::size_t k = 0; k < values.size(); k += 2, ++entry)
        values[k] = entry->first.first, values[k + 1] = entry->first.second;
    });
    file_.write_grains(check::friction_left_behind, counts, [&](Index grain, std::span<double> values) {
      auto entry = first_of_grain(grain);
      for (double& value : values) value = (entry++)->second;
    });
  }
  /// In the file, offsets run through all grains; in the arrays of a rank, through its own grains.
  void write_offsets(const schema::Dataset<Index, 1>& dataset, const Counts& rows, const Counts& parts,
                     const std::vector<Index>& offset, Index ContactPlace::*row, Index ContactPlace::*part) {
    const Counts start = running_sums(parts);
    file_.write_running_numbers(dataset, rows, start.back(), [&](Index grain, std::span<Index> values) {
      const ContactPlace first = first_of(candidates_, grain);
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<Index>(start[at(grain)] + offset[at(first.*row) + i] - first.*part);
    });
  }

  GatheredFile& file_;
  const Model& model_;
  const Contact& contact_;
  const ContactCandidates& candidates_;
  ContactCounts counts_;
};

/// Writes what connects rigid surfaces and nodes: list_of(grain, surface) gives anchors or bonds.
template <class Lists>
void write_by_surface(GatheredFile& file, const Model& model, const SurfaceDatasets& datasets, std::size_t surfaces,
                      Lists&& list_of) {
  const auto visit = [&](Index grain, auto&& set) { // set(k, surface, entry)
    std::size_t k = 0;
    for (std::size_t surface = 0; surface < surfaces; ++surface)
      for (const auto& entry : list_of(grain, surface)) set(k++, static_cast<Index>(surface), entry);
  };
  const Counts counts = count_of_grains(file.ranks(), model, [&](Index grain) {
    std::size_t count = 0;
    for (std::size_t surface = 0; surface < surfaces; ++surface) count += list_of(grain, surface).size();
    return count;
  });
  file.write_grains(datasets.node, counts, [&](Index grain, std::span<Index> values) {
    visit(grain, [&](std::size_t k, Index, const auto& entry) { values[k] = entry.node; });
  });
  file.write_grains(datasets.surface, counts, [&](Index grain, std::span<Index> values) {
    visit(grain, [&](std::size_t k, Index surface, const auto&) { values[k] = surface; });
  });
  file.write_grains(datasets.values, counts, [&](Index grain, std::span<double> values) {
    visit(grain, [&](std::size_t k, Index, const auto& entry) {
      std::ranges::copy(row_of(entry), values.subspan(k * width<Row>).begin());
    });
  });
}

void write_grips(GatheredFile& file, const Model& model, const Grips& grips) {
  const Counts counts = count_of_grains(file.ranks(), model, [&](Index grain) {
    return grips.offset.empty() ? 0 : grips.offset[at(grain) + 1] - grips.offset[at(grain)];
  });
  if (std::ranges::all_of(counts, [](std::int64_t count) { return count == 0; })) return;
  const auto gripped = [&](Index grain, std::size_t k) { return grips.node[at(grips.offset[at(grain)]) + k]; };
  file.write_grains(check::grip_node, counts, [&](Index grain, std::span<Index> values) {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = gripped(grain, k).node;
  });
  file.write_grains(check::grip_side, counts, [&](Index grain, std::span<Index> values) {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = gripped(grain, k).side;
  });
  file.write_grains(check::grip_reference, counts, [&](Index grain, std::span<double> values) {
    for (std::size_t k = 0; 3 * k < values.size(); ++k)
      std::ranges::copy(gripped(grain, k).reference, values.subspan(3 * k).begin());
  });
}

} // namespace

void write_checkpoint(const std::string& path, const CheckpointState& state, const RunRecord& record,
                      const std::string& scenario_text, const Communicator& ranks) {
  const Model& model = state.model;
  GatheredFile file(ranks, model.ownership, path, schema::FileKind::checkpoint);
  write_identity(file, model, scenario_text);
  file.at_root([&](schema::FileWriter& writer) {
    write_record(writer, record);
    write_fields(writer, state.fields);
  });
  write_nodes(file, model, state.grain_steps);
  write_tets(file, model);
  write_grain_numbers(file, state);
  ContactWriter contact(file, model, state.contact);
  contact.write_candidates();
  if (state.contact.bonding()) contact.write_bonds();
  if (state.contact.has_friction()) contact.write_friction();
  const Tools& tools = state.tools;
  if (state.wall_friction.present())
    write_by_surface(
        file, model, wall_anchors,
        walls, [&](Index grain, std::size_t wall) -> const auto& { return state.wall_friction.anchors(grain, wall); });
  if (tools.present())
    write_by_surface(
        file, model, tool_anchors,
        tools.size(), [&](Index grain, std::size_t tool) -> const auto& { return tools.anchors(grain, tool); });
  if (tools.adhere())
    write_by_surface(
        file, model, tool_bonds,
        tools.size(), [&](Index grain, std::size_t tool) -> const auto& { return tools.bonds(grain, tool); });
  write_grips(file, model, state.grips);
  file.commit();
}

} // namespace mpfem
