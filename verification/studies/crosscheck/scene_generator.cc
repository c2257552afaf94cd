#include <verification/studies/crosscheck/scene_generator.h>
#include <verification/studies/crosscheck/scene_maker.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::verification
{
  SceneMaker::SceneMaker(std::uint64_t seed, int index, int dimension)
    : random(seed, static_cast<std::uint64_t>(index))
    , dimension(dimension > 0 ? dimension : 1 + random.weighted({0.6, 0.35, 0.05}))
    , problem(static_cast<Problem>(random.weighted({0.76, 0.08, 0.1, 0.06})))
    , substance(random_substance(random, changes_phase()))
  {
    draft.set("", "title", "Random scene " + scene_name(seed, index).substr(6));
    draft.set("", "units", substance.si ? "SI" : "normalised");
  }

  SceneDraft SceneMaker::make()
  {
    if(problem == Problem::alloy)
      make_alloy_of_substance();
    if(problem == Problem::steady)
      draft.set("Scene", "problem", "poisson");
    choose_domain();
    choose_duration();
    choose_material();
    if(problem != Problem::steady)
      choose_start();
    choose_walls();
    if(changes_phase())
      choose_sources();
    const double released = problem == Problem::steady  ? 0.8
                            : problem == Problem::pure  ? 0.12
                            : problem == Problem::alloy ? 0
                                                        : 0.5;
    if(random.chance(released))
      choose_volumetric_source();
    if(!changes_phase())
      choose_inclusion();
    if(problem == Problem::alloy)
      choose_solute();
    // What was added to the language later comes last: scenes of old seeds that call for
    // none of it stay what they were.
    if(problem == Problem::pure || problem == Problem::heat)
      vary_properties();
    if(problem == Problem::pure)
      spread_melting();
    if(!turn_about_axis())
      move_sources();
    if(problem == Problem::alloy)
      surround_alloy();
    if(problem == Problem::pure)
      displace_liquid();
    if(problem == Problem::pure)
      bend_front();
    bound_by_polygon();
    if(problem != Problem::steady)
      vary_along_walls();
    if(problem == Problem::pure || problem == Problem::heat)
      let_bodies_touch();
    return draft;
  }

  bool SceneMaker::changes_phase() const
  {
    return problem == Problem::pure || problem == Problem::alloy;
  }

  void SceneMaker::choose_duration()
  {
    const double spread = substance.length * substance.length / substance.diffusivity();
    duration = spread * random.log_uniform(0.02, 0.5);
    if(changes_phase())
    {
      const double part = random.log_uniform(0.1, 1);
      const double stefan_number
          = std::max(substance.solid_capacity, substance.liquid_capacity)
            * substance.temperature_scale / substance.latent_heat;
      duration = part * part * spread * (0.5 / stefan_number + 0.5);
    }
    duration = rounded(duration);
    if(problem != Problem::steady)
      // Much shorter than that nothing is resolved.
      draft.set("Scene", "end time", words(duration),
                {words(duration / 4), words(duration / 2)});
  }

  double SceneMaker::warmer(double shares) const
  {
    return rounded(substance.melting_temperature + shares * substance.temperature_scale);
  }

  Course SceneMaker::over_time(double from, double to)
  {
    return random_course(random, from, to, duration,
                         problem == Problem::steady ? 0 : 0.35);
  }

  double SceneMaker::random_sign()
  {
    return random.chance(0.5) ? 1 : -1;
  }

  std::string scene_name(std::uint64_t seed, int index)
  {
    return fmt::format("scene-{}-{}", seed, index);
  }

  SceneDraft random_scene(std::uint64_t seed, int index, int dimension)
  {
    return SceneMaker(seed, index, dimension).make();
  }
} // namespace meltfront::verification
