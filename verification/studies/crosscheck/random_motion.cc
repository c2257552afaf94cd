#include <verification/studies/crosscheck/scene_maker.h>

namespace meltfront::verification
{
  void SceneMaker::displace_liquid()
  {
    if(shape == "outline" || draft.value("Scene/Domain", "shape") == "axisymmetric"
       || !draft.value("Scene/Material", "solidus temperature").empty()
       || !random.chance(0.12))
      return;
    for(const char *moving :
        {"Scene/Source 1", "Scene/Source 2", "Scene/Volumetric source",
         "Scene/Material/Liquid", initial})
      draft.remove(moving);
    draft.remove("Scene/Material", "Gibbs-Thomson coefficient");
    substance.liquid_density
        = rounded(substance.solid_density * random.log_uniform(0.8, 1.25));
    write_substance(substance, true, draft);
    const std::string in = sides().front(),
                      out = shape == "box" ? "x_max" : sides().back();
    for(const std::string &side : {in, out})
      draft.remove("Scene/Walls/" + side);
    const bool from_wall = in != out && random.chance(0.5);
    if(from_wall)
    {
      start_sign = 1;
      draft.set(initial, "temperature", words(warmer(random.uniform(0.05, 1))));
    }
    else
      choose_start_with_front(random.chance(0.5) ? 3 : 4, -1, first, last);
    const auto hold_at = [this](const std::string &side, double shares)
    {
      draft.set("Scene/Walls/" + side, "kind", "fixed temperature");
      draft.set("Scene/Walls/" + side, "temperature", words(warmer(shares)));
    };
    if(in != out && (from_wall || random.chance(0.6)))
      hold_at(in, -random.uniform(0.1, 1));
    if(random.chance(0.6))
      hold_at(out, random.uniform(0.05, 1));
  }
} // namespace meltfront::verification
