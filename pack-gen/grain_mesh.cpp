#include "pack-gen/grain_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <gmsh.h>

#include "common/errors.hpp"
#include "pack-gen/parallel.hpp"
#include "pack-gen/random.hpp"
#include "pack-gen/separate_grains.hpp"
#include "pack-gen/step_optimiser.hpp"

namespace mpfem {

namespace {

constexpr double unit_ball_volume = 4.0 / 3.0 * std::numbers::pi;
constexpr double library_step = 1.02;

/// Starts gmsh once and stops it at the end of the program.
class Gmsh {
public:
  static std::mutex& session() {
    static Gmsh gmsh;
    return gmsh.mutex_;
  }

private:
  Gmsh() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
  }
  ~Gmsh() { gmsh::finalize(); }
  std::mutex mutex_;
};

/// Tets wanted in the unit ball.
double wanted_tets(double size_ratio) {
  return tets_per_cubed_size * unit_ball_volume * size_ratio * size_ratio * size_ratio;
}

struct Candidate {
  double interior_edge, skin;
};
// Found by trying a grid of both at 600, 4,800 and 130,000 tets a ball: these reach the largest critical steps.
constexpr Candidate candidates[] = {{1.05, 0.75}, {1.0, 0.75}, {1.05, 0.65}, {1.0, 0.85}, {0.95, 0.75}, {1.1, 0.7}};

} // namespace

std::vector<Tet> gmsh_tetrahedralize(const std::vector<Point>& points) {
  std::vector<double> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Point& p : points) coordinates.insert(coordinates.end(), p.begin(), p.end());
  std::vector<std::size_t> tags;
  {
    const std::lock_guard lock(Gmsh::session());
    // Gmsh perturbs the points a little with rand(), so that points on one sphere cause no trouble. The seed makes this
    // reproducible.
    std::srand(1);
    gmsh::model::mesh::tetrahedralize(coordinates, tags);
  }
  std::vector<Tet> tet(tags.size() / 4);
  for (std::size_t e = 0; e < tet.size(); ++e) {
    Tet& t = tet[e];
    for (std::size_t k = 0; k < 4; ++k) t[k] = static_cast<std::int32_t>(tags[4 * e + k]) - 1;
    // Gmsh's order varies from call to call: sorted, the result depends on the points only.
    std::sort(t.begin(), t.end());
    const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(t[k])]; };
    if (tet_volume(at(0), at(1), at(2), at(3)) < 0) std::swap(t[2], t[3]);
  }
  std::sort(tet.begin(), tet.end());
  return tet;
}

namespace {

/// The tets of gmsh's current model and their nodes, put exactly on the sphere of a radius (mm) and the plane z = 0.
TetMesh read_half_ball(double radius) {
  TetMesh mesh;
  std::vector<std::size_t> tags, element, corner;
  std::vector<double> coordinate, parametric;
  gmsh::model::mesh::getNodes(tags, coordinate, parametric);
  gmsh::model::mesh::getElementsByType(4, element, corner);
  std::map<std::size_t, std::size_t> row;
  for (std::size_t i = 0; i < tags.size(); ++i) row[tags[i]] = i;
  std::map<std::size_t, std::int32_t> number; // of the nodes that tets have
  Tet tet{};
  for (std::size_t i = 0; i < corner.size(); ++i) {
    const auto [entry, is_new] = number.try_emplace(corner[i], static_cast<std::int32_t>(number.size()));
    if (is_new) {
      const double* x = &coordinate[3 * row.at(corner[i])];
      Point p{x[0], x[1], x[2]};
      const double distance = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
      if (std::abs(distance - radius) < 1e-7 * radius)
        for (double& c : p) c *= radius / distance;
      if (std::abs(p[2]) < 1e-9 * radius) p[2] = 0;
      mesh.node.push_back(p);
    }
    tet[i % 4] = entry->second;
    if (i % 4 == 3) mesh.tet.push_back(tet);
  }
  return mesh;
}

} // namespace

TetMesh gmsh_half_ball(double radius, const std::function<double(const Point&)>& size) {
  const std::lock_guard lock(Gmsh::session());
  std::srand(1);
  TetMesh mesh;
  try {
    gmsh::model::add("half ball");
    // The poles of the sphere's parametrisation, where triangles are poor, lie on the rim: the tip is an ordinary
    // point.
    constexpr double right_angle = std::numbers::pi / 2;
    gmsh::model::occ::addSphere(0, 0, 0, radius, 1, -right_angle, right_angle, 2 * right_angle);
    gmsh::model::occ::rotate({{3, 1}}, 0, 0, 0, 1, 0, 0, right_angle);
    gmsh::model::occ::synchronize();
    for (const char* off : {"Mesh.MeshSizeExtendFromBoundary", "Mesh.MeshSizeFromPoints", "Mesh.MeshSizeFromCurvature"})
      gmsh::option::setNumber(off, 0);
    gmsh::option::setNumber("Mesh.Algorithm", 6);   // frontal Delaunay: the most uniform triangles
    gmsh::option::setNumber("Mesh.Algorithm3D", 1); // Delaunay
    gmsh::option::setNumber("Mesh.Optimize", 1);
    gmsh::model::mesh::setSizeCallback([&size](int, int, double x, double y, double z) { return size({x, y, z}); });
    gmsh::model::mesh::generate(3);
    mesh = read_half_ball(radius);
    gmsh::model::mesh::removeSizeCallback();
    gmsh::model::remove();
  } catch (const std::exception& error) {
    throw SimulationError(fmt::format("gmsh could not mesh the half-ball: {}", error.what()));
  } catch (...) { // gmsh throws numbers or strings too
    std::string reason;
    gmsh::logger::getLastError(reason);
    throw SimulationError(
        fmt::format("gmsh could not mesh the half-ball: {}", reason.empty() ? "no reason given" : reason));
  }
  for (Tet& t : mesh.tet) {
    const auto at = [&](std::size_t k) { return mesh.node[static_cast<std::size_t>(t[k])]; };
    if (tet_volume(at(0), at(1), at(2), at(3)) < 0) std::swap(t[2], t[3]);
  }
  if (const std::string defect = ball_defect(mesh); !defect.empty())
    throw SimulationError(fmt::format("gmsh made no valid mesh of the half-ball: {}", defect));
  return mesh;
}

namespace {

/// Candidates for the mesh of the unit ball: laid out by gmsh, whose failures are counted.
class UnitBallSearch {
public:
  UnitBallSearch(double size_ratio, std::uint64_t seed)
      : wanted_(wanted_tets(size_ratio)), seed_(seed), rounds_(is_large() ? 5 : 10),
        factor_(1 - 0.9 / std::cbrt(wanted_)) {}

  double wanted() const { return wanted_; }
  bool is_large() const { return wanted_ > 20000; }
  /// Edge of the regular tetrahedron of the mean volume.
  double mean_edge() const { return std::cbrt(6 * std::numbers::sqrt2 * unit_ball_volume / wanted_); }
  int failures() const { return failures_; }
  const std::string& last_defect() const { return last_defect_; }

  /// The candidate's mesh with nearly the wanted number of tets; an empty one if that was not met.
  BallMesh find(std::size_t candidate) {
    fit_size(candidate);
    // Laid out again until the count is within 1.5 %. After six attempts the best count is taken: within 3 %, or within
    // 15 % for small balls, where one node more or less is already that much.
    double closest = std::numeric_limits<double>::infinity();
    BallMesh ball;
    for (std::uint64_t fit = 0; fit < 6 && !(closest < 0.015); ++fit) {
      BallMesh trial = lay_out(candidate, rounds_, fit);
      if (trial.mesh.tet.empty()) continue;
      const double miss = std::abs(std::log(ratio(trial)));
      factor_ *= std::cbrt(ratio(trial));
      if (miss < closest) {
        closest = miss;
        ball = std::move(trial);
      }
    }
    const double tolerance = wanted_ < 300 ? 0.15 : 0.03;
    return closest < tolerance ? std::move(ball) : BallMesh{};
  }

private:
  /// Tets over those wanted.
  double ratio(const BallMesh& ball) const { return static_cast<double>(ball.mesh.tet.size()) / wanted_; }

  /// After two rounds of smoothing the count is nearly final: the size is corrected then, while that is cheap.
  void fit_size(std::size_t candidate) {
    for (int fit = 0; fit < 3; ++fit) {
      const BallMesh trial = lay_out(candidate, 2, 0);
      if (trial.mesh.tet.empty()) continue;
      factor_ *= std::cbrt(ratio(trial));
      if (std::abs(std::log(ratio(trial))) < 0.01) break;
    }
  }

  /// Empty if gmsh failed; then the next size is 1 % smaller.
  BallMesh lay_out(std::size_t number, int smoothing, std::uint64_t shift) {
    const Candidate& candidate = candidates[number % std::size(candidates)];
    BallMesh trial;
    std::string defect;
    try {
      trial = lay_out_ball({.edge = mean_edge() * factor_,
                            .interior_edge = candidate.interior_edge,
                            .skin = candidate.skin,
                            .smoothing = smoothing,
                            .seed = seed_ + 1000 * number + shift},
                           gmsh_tetrahedralize);
      defect = ball_defect(trial.mesh);
    } catch (const std::exception& error) {
      defect = error.what();
    }
    if (defect.empty()) return trial;
    last_defect_ = defect;
    ++failures_;
    factor_ *= 0.99;
    return {};
  }

  double wanted_; ///< tets
  std::uint64_t seed_;
  int rounds_;    ///< of smoothing
  double factor_; ///< of the edge, for the count that smoothing leads to
  int failures_ = 0;
  std::string last_defect_ = "no candidate has the requested number of tetrahedra";
};

} // namespace

UnitBall mesh_unit_ball(double size_ratio, std::uint64_t seed, bool optimise) {
  UnitBallSearch search(size_ratio, seed);
  const bool large = search.is_large();
  const int sweeps = large ? 80 : 60;
  // The worst tet depends on chance: further tries follow until one has the smallest step (in units of size/wave speed)
  // that most sizes reach within three. Measured at radius/size 3.3 to 13; a try of a large ball gains less, and costs
  // more.
  const double enough = !optimise ? 0 : large ? 0.315 : search.wanted() > 2500 ? 0.32 : 0.325;
  const std::size_t tries = large ? 4 : 8;

  UnitBall best;
  for (std::size_t c = 0; c < tries + static_cast<std::size_t>(std::min(search.failures(), 10)); ++c) {
    if (best.smallest_step > 0 && best.smallest_step * size_ratio >= enough) break;
    BallMesh ball = search.find(c);
    if (ball.mesh.tet.empty()) continue;
    if (optimise) raise_smallest_step(ball, search.mean_edge(), sweeps, 1.3, seed);
    const double step = smallest_unit_step(ball.mesh);
    if (step > best.smallest_step && ball_defect(ball.mesh).empty()) best = {std::move(ball), 0, step, {}};
  }
  if (best.ball.mesh.tet.empty())
    throw SimulationError(fmt::format(
        "gmsh made no valid mesh of a sphere with radius/element size {:.3f} in {} attempts: {}", size_ratio,
        tries + static_cast<std::size_t>(std::min(search.failures(), 10)), search.last_defect()));
  best.volume = mesh_volume(best.ball.mesh);
  if (search.failures() > 0)
    best.note =
        fmt::format("radius/element size {:.3f}: gmsh failed {} times ({}); repeated with a size changed by 1 %",
                    size_ratio, search.failures(), search.last_defect());
  return best;
}

namespace {

/// Library key of a ratio radius/size: steps of 2 %.
int library_key(double size_ratio) {
  return static_cast<int>(std::lround(std::log(size_ratio) / std::log(library_step)));
}

/// Nodes of a library mesh for one sphere: turned, scaled to the sphere's exact volume, moved to its centre.
void place_grain(const UnitBall& unit, const Point& center, double radius, std::uint64_t seed, double* node) {
  const Eigen::Matrix3d turn = radius * std::cbrt(unit_ball_volume / unit.volume) * Random(seed).rotation();
  for (const Point& p : unit.ball.mesh.node) {
    for (int k = 0; k < 3; ++k)
      node[k] = center[static_cast<std::size_t>(k)] + turn(k, 0) * p[0] + turn(k, 1) * p[1] + turn(k, 2) * p[2];
    node += 3;
  }
}

std::uint64_t orientation_seed(std::uint64_t seed, std::size_t grain, int attempt) {
  return seed * 0x9E3779B97F4A7C15ULL + grain * 0xBF58476D1CE4E5B9ULL + static_cast<std::uint64_t>(attempt);
}

void report(const MeshRequest& request, double fraction, const std::string& what) {
  if (request.progress) request.progress(fraction, what);
}

using Library = std::map<int, UnitBall>;

/// Memory for one tet from the mesh to its file: 44 to 57 bytes at 1 to 4 million tets in 10 to 329 grains, the more
/// the larger the finest of the library's balls.
constexpr double least_bytes_per_tet = 40;

/// Throws InputError for more tets than can be numbered, or surely more than the memory (bytes) can hold.
void refuse_too_many(double tets, double size, double memory) {
  constexpr double most = 0.95 * std::numeric_limits<std::int32_t>::max(), gib = 1024.0 * 1024 * 1024;
  if (tets > most)
    throw InputError(fmt::format("size {:g} mm would give {:.3g} tetrahedra, allowed: at most {:.3g} (32-bit numbers)",
                                 size, tets, most));
  if (tets * least_bytes_per_tet > memory)
    throw InputError(fmt::format("size {:g} mm would give {:.3g} tetrahedra, which need at least {:.3g} GiB, allowed: "
                                 "the {:.3g} GiB of memory that are free here",
                                 size, tets, tets * least_bytes_per_tet / gib, memory / gib));
}

/// Library key of every sphere. Throws InputError if a sphere is too small for the size, or there are too many tets.
std::vector<int> library_keys(const SpherePacking& packing, double size, double memory) {
  std::vector<int> key(packing.radius.size());
  double tets_wanted = 0;
  for (std::size_t i = 0; i < key.size(); ++i) {
    const double ratio = packing.radius[i] / size;
    if (ratio < smallest_size_ratio)
      throw InputError(
          fmt::format("size {:g} mm is too large for sphere {} of radius {:g} mm, allowed: at most {:g} mm", size, i,
                      packing.radius[i], packing.radius[i] / smallest_size_ratio));
    key[i] = library_key(ratio);
    tets_wanted += wanted_tets(ratio);
  }
  refuse_too_many(tets_wanted, size, memory);
  return key;
}

/// Meshes the balls of these keys, largest first so that the threads end together.
Library make_library(const std::set<int>& wanted, const MeshRequest& request) {
  const std::vector<int> keys(wanted.rbegin(), wanted.rend());
  double work = 0, done = 0;
  for (const int k : keys) work += std::pow(library_step, 3 * k);
  Library library;
  std::mutex guard;
  report(request, 0, "meshing spheres");
  for_each_parallel(keys.size(), request.threads, [&](std::size_t i) {
    UnitBall unit =
        mesh_unit_ball(std::pow(library_step, keys[i]), static_cast<std::uint64_t>(keys[i] + 10000), request.optimise);
    const std::lock_guard lock(guard);
    library.emplace(keys[i], std::move(unit));
    done += std::pow(library_step, 3 * keys[i]);
    report(request, 0.9 * done / work, fmt::format("meshing spheres of {} sizes", keys.size()));
  });
  return library;
}

/// Room for all grains, one after the other, and their tets.
PackingMesh make_room(const Library& library, const std::vector<int>& key) {
  PackingMesh mesh;
  mesh.grain_node_offset.assign(key.size() + 1, 0);
  mesh.grain_tet_offset.assign(key.size() + 1, 0);
  std::size_t nodes = 0, tets = 0;
  for (std::size_t i = 0; i < key.size(); ++i) {
    const TetMesh& unit = library.at(key[i]).ball.mesh;
    nodes += unit.node.size();
    tets += unit.tet.size();
    mesh.grain_node_offset[i + 1] = static_cast<std::int32_t>(nodes);
    mesh.grain_tet_offset[i + 1] = static_cast<std::int32_t>(tets);
  }
  mesh.node.resize(3 * nodes);
  mesh.tet.resize(4 * tets);
  return mesh;
}

} // namespace

PackingMesh mesh_packing(const SpherePacking& packing, const MeshRequest& request) {
  const std::vector<int> key = library_keys(packing, request.nominal_size, request.memory);
  const Library library = make_library({key.begin(), key.end()}, request);
  PackingMesh mesh = make_room(library, key);
  for (const auto& entry : library)
    if (!entry.second.note.empty()) mesh.notes.push_back(entry.second.note);
  const auto place = [&](std::size_t i, int attempt, double* node) {
    place_grain(library.at(key[i]), packing.center[i], packing.radius[i], orientation_seed(request.seed, i, attempt),
                node);
  };
  for_each_parallel(key.size(), request.threads, [&](std::size_t i) {
    place(i, 0, mesh.node.data() + 3 * static_cast<std::size_t>(mesh.grain_node_offset[i]));
    std::int32_t* tet = mesh.tet.data() + 4 * static_cast<std::size_t>(mesh.grain_tet_offset[i]);
    for (const Tet& t : library.at(key[i]).ball.mesh.tet)
      for (const std::int32_t corner : t) *tet++ = mesh.grain_node_offset[i] + corner;
  });

  // Meshes of neighbours must stay apart.
  report(request, 0.9, "rotating grains until none touch");
  if (const std::size_t turned = separate_grains(packing, mesh, request.nominal_size, request.threads, place);
      turned > 0)
    mesh.notes.push_back(fmt::format("{} grains were rotated to keep their facets apart", turned));
  return mesh;
}

} // namespace mpfem
