#include <cases/case_file/alloy_reader.h>
#include <cases/case_file/conduction_reader.h>
#include <cases/case_file/exact_construction.h>
#include <cases/case_file/exact_reader.h>
#include <cases/case_file/key_builders.h>
#include <cases/case_file/manufactured_reader.h>
#include <cases/case_file/oracle_reader.h>
#include <cases/exact/flux_freezing.h>
#include <cases/exact/frank.h>
#include <cases/exact/line_sink.h>
#include <cases/exact/mushy_layer.h>
#include <cases/exact/planar_neumann.h>
#include <cases/exact/point_sink.h>
#include <cases/exact/varying_neumann.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::cases
{
  double far_temperature(const PrmFile &prm, const Scene &scene)
  {
    if(prm.given(exact_keys, "far temperature") || !scene.initial.temperature.constant)
      return prm.get_number(exact_keys, "far temperature");
    return scene.initial.temperature({}, scene.start_time);
  }

  namespace
  {

    /** The temperature of the wall: as given, else that at which the scene holds x_min.
     */
    double wall_temperature(const PrmFile &prm, const Scene &scene)
    {
      const auto &wall = scene.boundaries[static_cast<std::size_t>(Side::x_min)];
      const bool held
          = wall && wall->kind == BoundaryKind::fixed_temperature && wall->value.constant;
      if(prm.given(exact_keys, "wall temperature") || !held)
        return prm.get_number(exact_keys, "wall temperature");
      return wall->value({}, scene.start_time);
    }

    void check_symmetry(const PrmFile &prm, const Scene &scene,
                        const ExactSolution &solution, const std::string &key)
    {
      const Symmetry symmetry = solution.symmetry();
      const int dimension = scene.domain.dimension;
      const bool fits
          = scene.symmetry == symmetry
            || (scene.symmetry == Symmetry::none
                && (symmetry == Symmetry::planar
                    || dimension == (symmetry == Symmetry::cylindrical ? 2 : 3)));
      if(!fits)
        throw prm.error(exact_keys, key,
                        fmt::format("contradicts the domain: '{}' does not solve a {} "
                                    "scene in {} dimension{}",
                                    prm.get_text(exact_keys, key),
                                    prm.get_text("Scene", "symmetry"), dimension,
                                    dimension == 1 ? "" : "s"));
    }

    /** Of a material whose properties depend on temperature or that melts over a range.
     */
    std::shared_ptr<const ExactSolution> varying_neumann(const PrmFile &prm,
                                                         const Scene &scene, double far)
    {
      const double wall = wall_temperature(prm, scene);
      try
      {
        return std::make_shared<VaryingNeumann>(VaryingMaterial::of(scene.material), wall,
                                                far);
      }
      catch(const std::exception &error)
      {
        throw prm.error(exact_keys, "kind",
                        fmt::format("gives no solution: {}", error.what()));
      }
    }
  } // namespace

  KnownSolution closed_form(const PrmFile &prm, const Scene &scene,
                            const std::string &key)
  {
    const std::string kind = prm.get_text(exact_keys, key);
    const double far = far_temperature(prm, scene);
    if(kind == "line sink" || kind == "point sink")
    {
      prm.require(exact_keys, "lambda", "the solution of a sink needs it");
      prm.forbid(exact_keys, "wall temperature", "the solution of a sink has no wall");
    }
    else
      prm.forbid(exact_keys, "lambda", "it is a key of the solutions of sinks");
    KnownSolution known;
    if(kind == "neumann" && scene.material.curves)
      known.solution = varying_neumann(prm, scene, far);
    else if(kind == "neumann")
      known.solution = construct<PlanarNeumann>(prm, scene.material,
                                                wall_temperature(prm, scene), far);
    else if(kind == "frank")
      known.solution = construct<FrankGrowth>(prm, scene.material, scene.symmetry, far);
    else if(kind == "line sink")
    {
      const auto sink = construct<LineSink>(prm, scene.material,
                                            prm.get_number(exact_keys, "lambda"), far);
      known = {sink, false, [sink](double) { return -sink->strength(); },
               [sink](double time) { return -sink->strength() * time; }};
    }
    else
    {
      const auto sink = construct<PointSink>(prm, scene.material,
                                             prm.get_number(exact_keys, "lambda"), far);
      known = {sink, false, [sink](double time) { return -sink->strength(time); },
               [sink](double time) { return -sink->energy(time); }};
    }
    check_symmetry(prm, scene, *known.solution, key);
    return known;
  }

  namespace
  {
    constexpr const char *far_concentrations[]
        = {"far concentration", "far second concentration"};

    /** What the melt holds far from the wall: what it holds at the start, or as given
     * where the start is the exact solution's. */
    std::vector<double> far_concentration(const PrmFile &prm, const Scene &scene)
    {
      std::vector<double> result;
      for(std::size_t s = 0; s < scene.alloy->solutes.size(); ++s)
      {
        const char *key = far_concentrations[s];
        if(scene.initial.concentration.empty())
        {
          prm.require(exact_keys, key, "the mushy layer freezes from a melt");
          result.push_back(prm.get_number(exact_keys, key));
          continue;
        }
        prm.forbid(exact_keys, key, "the initial state says it");
        const Field &initial = scene.initial.concentration[s];
        if(!initial.constant)
          throw prm.error("Scene/Initial state", concentration_key(s),
                          "must be the same everywhere for a mushy layer to be the exact "
                          "solution");
        result.push_back(initial({}, scene.start_time));
      }
      return result;
    }

    KnownSolution mushy_layer(const PrmFile &prm, const Scene &scene)
    {
      if(!scene.alloy)
        throw prm.error(exact_keys, "kind",
                        "cannot be 'mushy layer' for a pure substance: there is no "
                        "subsection 'Scene/Material/Solute 1'");
      prm.forbid(exact_keys, "lambda", "it is a key of the solutions of sinks");
      const auto layer = construct<MushyLayer>(
          prm, scene.material, *scene.alloy, far_concentration(prm, scene),
          wall_temperature(prm, scene), far_temperature(prm, scene));
      check_symmetry(prm, scene, *layer, "kind");
      KnownSolution known;
      known.solution = layer;
      for(std::size_t s = 0; s < scene.alloy->solutes.size(); ++s)
        known.concentration.push_back(
            {"exact", [layer, s](const Position &p, double time)
             { return layer->concentration(s, coordinate(Symmetry::planar, p), time); }});
      return known;
    }
  } // namespace

  KnownSolution read_exact_solution(const PrmFile &prm, const Scene &scene)
  {
    const std::string kind = prm.get_text(exact_keys, "kind");
    forbid_frontless_keys(prm, kind);
    if(!scene.conducts_heat() && kind != "none")
      throw prm.error(exact_keys, "kind",
                      fmt::format("must be 'none' where the problem is '{}': what is "
                                  "known exactly follows from the scene",
                                  to_string(scene.problem)));
    if(kind != "oracle")
      for(const char *key : {"start", "start time", "initial front"})
        prm.forbid(exact_keys, key, "it is a key of the oracle");
    if(kind != "mushy layer")
    {
      if(scene.alloy && kind != "none")
        throw prm.error(exact_keys, "kind",
                        fmt::format("cannot be '{}' for an alloy; what is known of one "
                                    "is 'mushy layer'",
                                    kind));
      for(const char *key : far_concentrations)
        prm.forbid(exact_keys, key, "it is a key of the mushy layer");
    }
    if(scene.domain.shape == DomainShape::axisymmetric && kind == "oracle")
      return read_oracle_in_half_section(prm, scene);
    if(scene.domain.shape == DomainShape::axisymmetric && kind != "none"
       && kind != "formula" && kind != "manufactured")
      throw prm.error(exact_keys, "kind",
                      fmt::format("cannot be '{}' in an axisymmetric domain", kind));
    if(kind == "manufactured")
      return read_manufactured_solution(prm, scene);
    forbid_manufactured_keys(prm);
    if(kind == "none")
    {
      for(const char *key : {"wall temperature", "far temperature", "lambda"})
        prm.forbid(exact_keys, key, "there is no exact solution");
      return {};
    }
    if(kind == "formula" || kind == "five-point lattice")
      return read_frontless_solution(prm, scene);
    if(!scene.changes_phase())
      throw prm.error(
          exact_keys, "kind",
          fmt::format("cannot be '{}' without latent heat: there is no front", kind));
    if(kind == "oracle")
      return read_oracle(prm, scene);
    return kind == "mushy layer" ? mushy_layer(prm, scene)
                                 : closed_form(prm, scene, "kind");
  }
} // namespace meltfront::cases
