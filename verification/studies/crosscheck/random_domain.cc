#include <verification/studies/crosscheck/scene_maker.h>

#include <fmt/format.h>

#include <array>

namespace meltfront::verification
{
  void SceneMaker::choose_domain()
  {
    const bool linear = problem == Problem::steady;
    if(dimension == 1)
    {
      const int kind = linear ? 0 : random.weighted({0.66, 0.1, 0.09, 0.08, 0.07});
      shape = std::array{"slab", "ball", "ball", "shell", "shell"}[kind];
      shape_dimension = std::array{1, 2, 3, 2, 3}[kind];
      symmetry = std::array{"planar", "cylindrical", "spherical"}[shape_dimension - 1];
    }
    else
    {
      shape_dimension = dimension;
      const bool plane = dimension == 2;
      const int kind = linear ? 0 : random.weighted({0.6, 0.2, 0.13, plane ? 0.07 : 0});
      shape = std::array{"box", "ball", "shell", "outline"}[kind];
      symmetry = "none";
    }
    draft.set("Scene", "symmetry", symmetry);
    const std::string here = "Scene/Domain";
    draft.set(here, "shape", shape);
    draft.set(here, "dimension", fmt::format("{}", shape_dimension));
    const double length = substance.length;
    last = length;
    if(shape == "slab")
      draft.set(here, "length", words(length));
    else if(shape == "box")
    {
      upper = {length, length, length};
      for(int d = 1; d < shape_dimension; ++d)
        upper[d] *= std::array{1., 1., 0.5, 1.5}[random.below(plane_or_less() ? 4 : 2)];
      draft.set(here, "lower corner", list({0, 0, 0}));
      draft.set(here, "upper corner", list(upper));
    }
    else if(round())
    {
      draft.set(here, "radius", words(length));
      if(shape == "shell")
      {
        first = rounded(length * random.uniform(0.2, 0.6));
        draft.set(here, "inner radius", words(first));
      }
    }
    else
      draft.set(here, "polar radius",
                fmt::format("{}*(1 + {}*cos(2*phi) + {}*sin(phi))", words(length / 2),
                            words(random.uniform(0, 0.2)),
                            words(random.uniform(0, 0.15))));
    coordinate = radius_or_x();
  }

  bool SceneMaker::turn_about_axis()
  {
    if(shape != "box" || shape_dimension != 2 || problem == Problem::steady
       || draft.has("Scene/Source 1") || draft.has("Scene/Inclusion")
       || !random.chance(0.15))
      return false;
    draft.set("Scene/Domain", "shape", "axisymmetric");
    // The axis, or a hole about it.
    if(random.chance(0.7))
      draft.remove("Scene/Walls/x_min");
    else
      draft.set("Scene/Domain", "lower corner",
                words(substance.length * random.uniform(0.2, 0.5)) + ", 0");
    return true;
  }

  bool SceneMaker::round() const
  {
    return shape == "ball" || shape == "shell";
  }

  bool SceneMaker::plane_or_less() const
  {
    return shape_dimension <= 2;
  }

  std::string SceneMaker::radius_or_x() const
  {
    if(!round() && shape != "outline")
      return "x";
    return shape_dimension == 2 ? "sqrt(x^2 + y^2)" : "sqrt(x^2 + y^2 + z^2)";
  }

  std::string SceneMaker::list(const std::array<double, 3> &values) const
  {
    std::string text;
    for(int d = 0; d < shape_dimension; ++d)
      text += (d > 0 ? ", " : "") + words(values[d]);
    return text;
  }

  std::vector<std::string> SceneMaker::sides() const
  {
    if(shape == "shell")
      return {"inner", "outer"};
    if(shape == "ball" || shape == "outline")
      return {"outer"};
    const std::vector<std::string> all{"x_min", "x_max", "y_min",
                                       "y_max", "z_min", "z_max"};
    return {all.begin(), all.begin() + 2 * shape_dimension};
  }
} // namespace meltfront::verification
