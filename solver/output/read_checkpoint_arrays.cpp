// Every rank reads the file itself, piece by piece, and keeps what belongs to its own grains.

#include <algorithm>
#include <numeric>

#include "common/index.hpp"
#include "solver/model/tets.hpp"
#include "solver/output/bond_laws.hpp"
#include "solver/output/checkpoint.hpp"
#include "solver/output/checkpoint_datasets.hpp"

namespace mpfem {

namespace {

using namespace checkpoint_datasets;
using Index = std::int32_t;

/// Reads arrays for the own grains of a model.
class ArrayReader {
public:
  ArrayReader(const schema::FileReader& file, const Model& model)
      : file_(file), model_(model), grains_(at(model.grains)) {}

  void take_nodes(Model& model, GrainSteps& steps) const;
  void take_tets(Model& model) const;
  void take_grain_numbers(GrainSteps& steps, Contact& contact) const;
  void take_candidates(Contact& contact);
  void take_bonds(Contact& contact, const BondParameters& parameters) const;
  void take_friction(Contact& contact) const;
  template <class Lists, class Make>
  void take_by_surface(const SurfaceDatasets& datasets, std::size_t surfaces, Lists&& list_of, Make&& make) const;
  void take_grips(Grips& grips) const;

private:
  /// Rows of a dataset in the file, by grain: [grains + 1], the first of each and the end.
  using Rows = std::vector<std::int64_t>;

  [[noreturn]] void fail_damaged() const { refuse_damaged_checkpoint(file_.path()); }
  /// Numbers read piece by piece are judged only when all have been read: by then damage to the file is known.
  void require(bool good) const {
    if (!good) fail_damaged();
  }
  template <class First>
  static std::int64_t row(const First& first, Index grain) {
    return static_cast<std::int64_t>(first[at(grain)]);
  }

  template <class T, int Rank, class First, class Take>
  void read_own(const schema::Dataset<T, Rank>& dataset, const First& first, Take&& take) const;
  template <class T, int Rank>
  std::vector<T> read_own(const schema::Dataset<T, Rank>& dataset, const Rows& first) const;
  /// Offsets of the parts of pairs or points, whose rows in the file `rows` gives.
  struct Parts {
    Rows first;                ///< part of each grain
    std::vector<Index> offset; ///< of own rows among own parts, and the end
  };
  Parts read_parts(const schema::Dataset<Index, 1>& dataset, const Rows& rows) const;
  Rows pairs_by_grain() const;
  Rows nodes_by_grain(const schema::Dataset<Index, 1>& dataset) const;

  const schema::FileReader& file_;
  const Model& model_;
  std::size_t grains_;
  Rows points_; ///< contact points; known once take_candidates() has been called
};

/// The parts of own grains in successive pieces of a dataset where grain g has the rows from first[g] on.
template <class First>
class OwnParts {
public:
  OwnParts(const std::vector<Index>& own, const First& first) : own_(own), first_(first) {}

  /// Calls take(grain, row, values) for own parts in the piece that begins with this row.
  template <class T, class Take>
  void of_piece(std::size_t piece_row, std::span<const T> piece, std::size_t columns, Take&& take) {
    const std::size_t piece_end = piece_row + piece.size() / columns;
    while (next_ < own_.size() && row(own_[next_] + 1) <= piece_row) ++next_;
    for (std::size_t k = next_; k < own_.size() && row(own_[k]) < piece_end; ++k) {
      const std::size_t begin = std::max(row(own_[k]), piece_row), end = std::min(row(own_[k] + 1), piece_end);
      if (begin < end) take(own_[k], begin, piece.subspan((begin - piece_row) * columns, (end - begin) * columns));
    }
  }

private:
  std::size_t row(Index grain) const { return static_cast<std::size_t>(first_[at(grain)]); }
  const std::vector<Index>& own_;
  const First& first_;
  std::size_t next_ = 0; ///< grains before it are done
};

/// Calls take(grain, row, values) with the rows of own grains in a dataset, a piece of a grain at a time.
template <class T, int Rank, class First, class Take>
void ArrayReader::read_own(const schema::Dataset<T, Rank>& dataset, const First& first, Take&& take) const {
  require(file_.rows(dataset) == static_cast<std::size_t>(first.back()));
  const std::size_t columns = Rank == 2 ? dataset.extent[1].fixed : 1;
  OwnParts parts(model_.own(), first);
  file_.read_in_pieces(dataset, [&](std::size_t piece_row, std::span<const T> piece) {
    parts.of_piece(piece_row, piece, columns, take);
  });
}

/// The same, one after another.
template <class T, int Rank>
std::vector<T> ArrayReader::read_own(const schema::Dataset<T, Rank>& dataset, const Rows& first) const {
  std::vector<T> values;
  read_own(dataset, first,
           [&](Index, std::size_t, std::span<const T> part) { values.insert(values.end(), part.begin(), part.end()); });
  return values;
}

void ArrayReader::take_nodes(Model& model, GrainSteps& steps) const {
  const auto copy_to = [](auto& array, std::size_t columns) {
    return [&array, columns](Index, std::size_t node, std::span<const double> values) {
      std::ranges::copy(values, array.begin() + static_cast<std::ptrdiff_t>(columns * node));
    };
  };
  for_each_node_array(model, [&](const auto& dataset, LazyArray<double>& array) {
    read_own(dataset, model.node_offset, copy_to(array, 4));
  });
  steps.contact = LazyArray<double>(at(model.nodes()), model.pages());
  read_own(check::node_step_contact, model.node_offset, copy_to(steps.contact, 1));
}

void ArrayReader::take_tets(Model& model) const {
  for_each_tet_array([&](const auto& dataset, const auto& place) {
    read_own(dataset, model.tet_offset, [&](Index grain, std::size_t first, std::span<const double> values) {
      const auto begin = static_cast<Index>(first), end = static_cast<Index>(first + values.size());
      for_tets_of(model, grain, begin, end, [&](auto& block, int lane, std::size_t tet) {
        auto& number = place(block)[lane];
        number = static_cast<std::remove_reference_t<decltype(number)>>(values[tet - first]);
      });
    });
  });
  fill_unused_lanes(model);
}

void ArrayReader::take_grain_numbers(GrainSteps& steps, Contact& contact) const {
  for_each_grain_array(steps, contact, [&](const auto& dataset, std::vector<double>& values) {
    values = file_.read(dataset);
    require(values.size() == grains_);
  });
}

/// Which pairs have each grain as their first.
ArrayReader::Rows ArrayReader::pairs_by_grain() const {
  Rows first(grains_ + 1, 0);
  bool good = true;
  Index last = 0;
  file_.read_in_pieces(check::contact_pair_first, [&](std::size_t, std::span<const Index> piece) {
    for (const Index grain : piece) {
      good = good && grain >= last && grain < model_.grains;
      if (!good) return;
      last = grain;
      ++first[at(grain) + 1];
    }
  });
  require(good);
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

ArrayReader::Parts ArrayReader::read_parts(const schema::Dataset<Index, 1>& dataset, const Rows& rows) const {
  require(file_.rows(dataset) == static_cast<std::size_t>(rows.back()) + 1);
  Parts parts{Rows(grains_ + 1, 0), {}};
  OwnParts own(model_.own(), rows);
  bool good = true;
  Index last = 0;
  std::size_t next = 0; // grain whose first part comes next
  file_.read_in_pieces(dataset, [&](std::size_t piece_row, std::span<const Index> piece) {
    for (const Index part : piece) {
      good = good && part >= last;
      last = part;
    }
    for (; next <= grains_ && static_cast<std::size_t>(rows[next]) < piece_row + piece.size(); ++next)
      parts.first[next] = piece[static_cast<std::size_t>(rows[next]) - piece_row];
    own.of_piece(piece_row, piece, 1, [&](Index, std::size_t, std::span<const Index> values) {
      parts.offset.insert(parts.offset.end(), values.begin(), values.end());
    });
  });
  require(good && parts.first.front() == 0);
  // From the numbers of the file to those of the rank.
  std::int64_t before = 0;
  auto offset = parts.offset.begin();
  for (const Index grain : model_.own()) {
    for (std::int64_t n = row(rows, grain); n < row(rows, grain + 1); ++n, ++offset)
      *offset = static_cast<Index>(*offset - row(parts.first, grain) + before);
    before += row(parts.first, grain + 1) - row(parts.first, grain);
  }
  parts.offset.push_back(static_cast<Index>(before));
  return parts;
}

void ArrayReader::take_candidates(Contact& contact) {
  ContactCandidates& candidates = contact.candidates;
  const Rows pairs = pairs_by_grain();
  candidates.pair_first = read_own(check::contact_pair_first, pairs);
  candidates.pair_second = read_own(check::contact_pair_second, pairs);
  require(std::ranges::all_of(candidates.pair_second, [&](Index g) { return g >= 0 && g < model_.grains; }));
  Parts points = read_parts(check::contact_pair_point_offset, pairs);
  candidates.pair_point_offset = std::move(points.offset);
  points_ = std::move(points.first);
  for_each_point_array(contact, [&](const auto& dataset, auto& array) { array = read_own(dataset, points_); });
  require(std::ranges::all_of(candidates.point_node, [&](Index n) { return n >= 0 && n < model_.nodes(); }));
  require(std::ranges::all_of(contact.point_facet, [&](Index f) { return f >= -1 && f < model_.facets(); }));
  Parts facets = read_parts(check::contact_point_facet_offset, points_);
  candidates.point_facet_offset = std::move(facets.offset);
  candidates.point_facet = read_own(check::contact_candidate_facet, facets.first);
  require(std::ranges::all_of(candidates.point_facet, [&](Index f) { return f >= 0 && f < model_.facets(); }));
  index_pairs(candidates, model_.grains);
  contact.force.resize(contact.point_facet.size());
  contact.active.assign(candidates.pair_first.size(), 0);
}

void ArrayReader::take_bonds(Contact& contact, const BondParameters& parameters) const {
  const BondLaw coming = contact.bond_laws.back();
  contact.bond_laws = unflatten_bond_laws(file_.read(check::bond_laws), parameters.normal_only);
  const std::size_t laws = contact.bond_laws.size();
  const auto facet = read_own(check::bond_facet, points_);
  const auto law =
      file_.has(check::bond_law) ? read_own(check::bond_law, points_) : std::vector<Index>(facet.size(), 0);
  const auto is_known = [&](Index number) { return number >= 0 && at(number) < laws; };
  require(laws > 0 && std::ranges::all_of(law, is_known));
  require(std::ranges::all_of(facet, [&](Index f) { return f >= -1 && f < model_.facets(); }));
  std::size_t point = 0;
  read_own(check::bond_values, points_, [&](Index, std::size_t, std::span<const double> values) {
    for (; !values.empty(); values = values.subspan(width<Row>), ++point)
      contact.bond[point] = bond_of(facet[point], law[point], values.first(width<Row>));
  });
  if (contact.bond_laws.back() != coming) contact.bond_laws.push_back(coming);
}

void ArrayReader::take_friction(Contact& contact) const {
  contact.point_friction.assign(contact.point_facet.size(), {});
  if (!file_.has(check::friction_facet)) return;
  const auto facet = read_own(check::friction_facet, points_);
  require(std::ranges::all_of(facet, [&](Index f) { return f >= -1 && f < model_.facets(); }));
  std::size_t point = 0;
  read_own(check::friction_values, points_, [&](Index, std::size_t, std::span<const double> values) {
    for (; !values.empty(); values = values.subspan(width<FrictionRow>), ++point)
      contact.point_friction[point] = friction_of(facet[point], values.first(width<FrictionRow>));
  });
  const auto grains = file_.read(check::friction_left_grains);
  const auto lost = file_.read(check::friction_left_behind);
  require(grains.size() == 2 * lost.size());
  require(std::ranges::all_of(grains, [&](Index grain) { return grain >= 0 && grain < model_.grains; }));
  for (std::size_t i = 0; i < lost.size(); ++i)
    if (model_.ownership.owns(grains[2 * i]))
      contact.friction_of_former_points[{grains[2 * i], grains[2 * i + 1]}] = lost[i];
}

/// Which rows have nodes of each grain; rows are sorted by grain.
ArrayReader::Rows ArrayReader::nodes_by_grain(const schema::Dataset<Index, 1>& dataset) const {
  Rows first(grains_ + 1, 0);
  bool good = true;
  std::size_t grain = 0;
  file_.read_in_pieces(dataset, [&](std::size_t, std::span<const Index> piece) {
    for (const Index node : piece) {
      good = good && node < model_.nodes();
      if (!good) return;
      while (node >= model_.node_offset[grain + 1]) ++grain;
      good = node >= model_.node_offset[grain];
      ++first[grain + 1];
    }
  });
  require(good);
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

/// For data sorted by grain, surface and node: calls make(node, values) for each entry and appends the result to
/// list_of(grain, surface), a pointer, which is null if the entry is to be left out.
template <class Lists, class Make>
void ArrayReader::take_by_surface(const SurfaceDatasets& datasets, std::size_t surfaces, Lists&& list_of,
                                  Make&& make) const {
  const Rows first = nodes_by_grain(datasets.node);
  const auto node = read_own(datasets.node, first), surface = read_own(datasets.surface, first);
  require(std::ranges::all_of(surface, [&](Index s) { return s >= 0 && at(s) < surfaces; }));
  bool good = true;
  std::size_t i = 0;
  read_own(datasets.values, first, [&](Index grain, std::size_t, std::span<const double> values) {
    for (; !values.empty(); values = values.subspan(width<Row>), ++i) {
      auto* list = list_of(grain, at(surface[i]));
      if (list == nullptr) continue;
      good = good && (list->empty() || list->back().node < node[i]);
      list->push_back(make(node[i], values.first(width<Row>)));
    }
  });
  require(good);
}

void ArrayReader::take_grips(Grips& grips) const {
  const Rows first = nodes_by_grain(check::grip_node);
  const auto node = read_own(check::grip_node, first), side = read_own(check::grip_side, first);
  require(std::ranges::all_of(side, [](auto s) { return s == 0 || s == 1; }));
  const auto reference = read_own(check::grip_reference, first);
  for (std::size_t i = 0; i < node.size(); ++i)
    grips.node.push_back({node[i], side[i], {reference[3 * i], reference[3 * i + 1], reference[3 * i + 2]}});
  grips.make_offsets(model_.node_offset);
}

/// Lists that only grow while they are read: a checkpoint that was read before may have left some.
void forget_histories(Contact& contact, WallFriction& wall_friction, Tools& tools) {
  contact.friction_of_former_points.clear();
  wall_friction.forget({true, true, true});
  tools.forget();
}

} // namespace

void CheckpointReader::take_arrays(Model& model, Contact& contact, WallFriction& wall_friction, Tools& tools,
                                   GrainSteps& grain_steps, Grips* grips,
                                   const std::optional<BondParameters>& bond_parameters) const {
  forget_histories(contact, wall_friction, tools);
  ArrayReader reader(file_, model);
  reader.take_nodes(model, grain_steps);
  reader.take_tets(model);
  reader.take_grain_numbers(grain_steps, contact);
  reader.take_candidates(contact);
  if (contact.bonding()) {
    // A checkpoint without bonds goes on with them: they form where grains touch.
    const std::size_t points = contact.point_facet.size();
    contact.bond.assign(points, {});
    contact.bond_force.resize(points);
    contact.pulling.assign(contact.candidates.pair_first.size(), 0);
    if (bond_parameters) reader.take_bonds(contact, *bond_parameters);
  }
  if (contact.has_friction()) reader.take_friction(contact);
  if (wall_friction.present() && file_.has(check::wall_friction_node))
    reader.take_by_surface(
        wall_anchors, walls, [&](int grain, std::size_t wall) { return &wall_friction.anchors(grain, wall); },
        anchor_of);
  if (tools.present() && file_.has(check::tool_friction_node))
    reader.take_by_surface(
        tool_anchors, tools.size(),
        [&](int grain, std::size_t tool) { return tools[tool].friction > 0 ? &tools.anchors(grain, tool) : nullptr; },
        anchor_of);
  if (tools.adhere() && file_.has(check::tool_adhesion_node))
    reader.take_by_surface(
        tool_bonds, tools.size(),
        [&](int grain, std::size_t tool) { return tools[tool].adhesion ? &tools.bonds(grain, tool) : nullptr; },
        tool_bond_of);
  if (grips && file_.has(check::grip_node)) reader.take_grips(*grips);
}

} // namespace mpfem
