#pragma once
// Rigid tools: surfaces that stages move, with friction, and what they bear.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "solver/boundary/cell.hpp"
#include "solver/boundary/surface_adhesion.hpp"
#include "solver/boundary/surface_friction.hpp"
#include "solver/boundary/tool_surfaces.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

using ToolSurface = std::variant<OrientedPlane, CylinderSurface, SphereSurface, ConeSurface, BodySurface>;

/// What a tool bears from grains.
struct ToolLoad {
  Vector3<double> force{0, 0, 0};  ///< N, of the grains on the tool
  Vector3<double> moment{0, 0, 0}; ///< N mm, of these forces about the tool's reference point
  double normal_force = 0;         ///< N, sum of the normal forces, pulls of bonds negative
  double energy = 0;               ///< mJ, in the penalty
  double friction_energy = 0;      ///< mJ, in stick springs
  double friction_dissipation = 0; ///< mJ, since the time level before
  double adhesion_energy = 0;      ///< mJ, in bonds to the tool
  double adhesion_dissipation = 0; ///< mJ, by damage of these bonds since the time level before
  double bonded_area = 0;          ///< mm^2, of bonds that are not broken
  double penetration = 0;          ///< the largest, over the element size

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    for (auto* vector : {&s.force, &s.moment}) visit.sum(vector->x), visit.sum(vector->y), visit.sum(vector->z);
    visit.sum(s.normal_force), visit.sum(s.energy), visit.sum(s.friction_energy), visit.sum(s.friction_dissipation);
    visit.sum(s.adhesion_energy), visit.sum(s.adhesion_dissipation), visit.sum(s.bonded_area);
    visit.largest(s.penetration);
  }
  /// Whether the tool exerts a force on any node.
  bool acts() const { return penetration > 0 || adhesion_energy > 0; }
};

/// One tool at a time level.
struct Tool {
  std::string name;
  ToolSurface surface;                ///< in its starting position
  double friction = 0;                ///< mu
  std::optional<Adhesion> adhesion{}; ///< none: nothing sticks to it
  std::uint64_t triangles = 0;        ///< hash of the triangles of an STL file; 0 for other shapes
  std::string size{};                 ///< of an STL file's body beside the packing, for messages; else empty
  bool away = false;                  ///< it touches nothing
  std::array<double, 3> moved{};      ///< mm, since the start of the run
  std::array<double, 3> movement{};   ///< mm, in the step that led to the present
  std::array<double, 3> force{};      ///< N, of the grains on it at the last time level
  double work = 0;                    ///< mJ, done on the grains so far, less what it took along when it left
  double friction_dissipation = 0;    ///< mJ, so far
  double adhesion_dissipation = 0;    ///< mJ, so far

  template <class Self, class Visitor>
  static void for_each_field(Self& s, Visitor&& visit) {
    visit("tool.triangles", s.triangles), visit("tool.away", s.away), visit("tool.moved", s.moved),
        visit("tool.movement", s.movement);
    visit("tool.force", s.force), visit("tool.work", s.work);
    visit("tool.friction_dissipation", s.friction_dissipation);
    visit("tool.adhesion_dissipation", s.adhesion_dissipation);
  }
};

/// All tools of a run: their places, forces and work, and what sticks to them.
class Tools {
public:
  Tools(std::vector<Tool> tools, int grains);

  bool present() const { return !tools_.empty(); }
  std::size_t size() const { return tools_.size(); }
  const Tool& operator[](std::size_t tool) const { return tools_[tool]; }

  // ---- a step
  /// Adds the tools' forces on a grain to model.force. `bounds`: the current bounding box of the grain's surface;
  /// `last_step` in s. Different grains may be handled at the same time.
  void add_forces(Model& model, const Bounds& bounds, double last_step, int grain);
  /// Collective. Adds up what the tools bear at this time level. Returns their work (mJ) on the grains since the level
  /// before, by the trapezoidal rule.
  double take_loads(const Communicator& ranks, const Ownership& ownership);
  /// What a tool bears, as last summed.
  const ToolLoad& load(std::size_t tool) const { return load_[tool]; }
  /// What all tools bear together.
  ToolLoad total() const;
  /// mJ, lost so far by damage of bonds to tools.
  double adhesion_dissipation() const;
  /// Moves every tool by one step; `velocity` (mm/s) of each, or none where all are at rest.
  void move(std::span<const std::array<double, 3>> velocity, double step);
  /// Adds K A/m (1/s^2) of the tools that each node touches to `rate` [nodes], and what bonds to tools add, also those
  /// that may form before the next estimate.
  void add_stiffness_rate(const Model& model, const Bounds& bounds, int grain, std::span<double> rate) const;
  /// N, the normal pushes of all tools on the contact point of a surface node, less the pulls of bonds to them.
  double push_on_node(const Model& model, std::size_t node, int grain) const;

  // ---- tools that leave and return
  /// Collective. From now on these tools and no others are away, and bonds to them are cut. The forces that leaving
  /// tools exert at this time level are taken out of model.force; `last_step` (s) led to it. Returns the energy (mJ)
  /// that they take along: what they store, and the part of the kinetic energy (node_motion.hpp) that goes with their
  /// forces. Tools that return stand where they touch no grain: planes along their normal, others back along the way in
  /// which the stage drives them (`ways` [tools], unit vectors; 0: none). `bounds` [grains], of their surfaces. Throws
  /// SimulationError if a tool would return inside grains.
  double set_away(std::span<const std::size_t> away, std::span<const std::array<double, 3>> ways, Model& model,
                  std::span<const Bounds> bounds, double last_step, const Communicator& ranks);
  /// In words, which tools the last set_away() has moved back, and how far.
  std::span<const std::string> moved_back() const { return moved_back_; }
  /// Index and depth (mm) of the tool that a surface node is deepest behind; none where it is behind none.
  std::optional<std::pair<std::size_t, double>> behind(const Model& model, std::size_t node) const;

  // ---- checkpoints
  template <class Writer>
  void write(Writer& to) const {
    for (const Tool& tool : tools_) Tool::for_each_field(tool, to);
  }
  /// Reads the first `saved` tools. Those after them are new: they are away until a stage places them. Throws
  /// InputError if the triangles of an STL file are not those that were saved.
  template <class Reader>
  void read(Reader& from, std::size_t saved) {
    for (std::size_t tool = 0; tool < size(); ++tool) {
      const std::uint64_t triangles = tools_[tool].triangles;
      if (tool < saved)
        Tool::for_each_field(tools_[tool], from);
      else
        tools_[tool].away = true;
      if (tools_[tool].triangles != triangles) refuse_triangles(tool);
    }
  }
  /// Forgets what nodes rub on and stick to.
  void forget();
  int grains() const { return grains_; }
  /// By ascending node.
  std::vector<SurfaceAnchor>& anchors(int grain, std::size_t tool) { return anchors_[slot(grain, tool)]; }
  const std::vector<SurfaceAnchor>& anchors(int grain, std::size_t tool) const { return anchors_[slot(grain, tool)]; }
  /// Whether anything may stick to any tool.
  bool adhere() const;
  std::vector<SurfaceBond>& bonds(int grain, std::size_t tool) { return bonds_[slot(grain, tool)]; }
  const std::vector<SurfaceBond>& bonds(int grain, std::size_t tool) const { return bonds_[slot(grain, tool)]; }

private:
  [[noreturn]] void refuse_triangles(std::size_t tool) const;
  std::size_t slot(int grain, std::size_t tool) const { return static_cast<std::size_t>(grain) * size() + tool; }
  ToolLoad add_tool(Model& model, std::size_t tool, const Bounds& bounds, double last_step, int grain);
  double pull_on_node(const Model& model, std::size_t node, int grain, std::size_t tool) const;
  double remove_forces_on_grain(Model& model, std::size_t tool, const Bounds& bounds, double last_step, int grain);
  double remove_forces_on_all_grains(Model& model, std::size_t tool, std::span<const Bounds> bounds, double last_step,
                                     const Communicator& ranks);

  int grains_ = 0;
  std::vector<Tool> tools_;
  std::vector<std::string> moved_back_;
  std::vector<ToolLoad> of_grain_;                  ///< [grains * tools]
  std::vector<ToolLoad> load_;                      ///< [tools]
  std::vector<std::vector<SurfaceAnchor>> anchors_; ///< [grains * tools]
  std::vector<std::vector<SurfaceBond>> bonds_;     ///< [grains * tools]
};

} // namespace mpfem
