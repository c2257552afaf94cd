#include <cases/error.h>
#include <particles/greenspan/greenspan.h>
#include <particles/level_set/front_methods.h>
#include <particles/moab_integral/moab_integral.h>
#include <particles/rkpm/rkpm.h>
#include <particles/rkpm_tracked/rkpm_tracked.h>
#include <particles/sph/sph.h>
#include <particles/sph_mixture/sph_mixture.h>
#include <particles/sph_two_population/sph_two_population.h>
#include <particles/voronoi_fv/voronoi_fv.h>
#include <reference_fem/cut/cut.h>
#include <reference_fem/enthalpy/enthalpy.h>
#include <reference_fem/fitted/fitted.h>
#include <verification/app/methods.h>
#include <verification/external/external.h>

#include <fmt/format.h>

#include <filesystem>

namespace meltfront::verification
{
  namespace
  {
    MethodList methods_of_this_program()
    {
      MethodList list;
      list.push_back(particles::make_sph());
      list.push_back(particles::make_sph_2005());
      list.push_back(particles::make_sph_mixture());
      list.push_back(particles::make_sph_two_population());
      list.push_back(particles::make_sph_two_population_2005());
      for(auto &method : particles::make_rkpm_methods())
        list.push_back(std::move(method));
      list.push_back(particles::make_moab_integral());
      list.push_back(particles::make_voronoi_fv());
      list.push_back(particles::make_rkpm_tracked());
      list.push_back(particles::make_greenspan());
      for(auto &method : particles::make_level_set_methods())
        list.push_back(std::move(method));
      list.push_back(reference_fem::make_fem_enthalpy());
      list.push_back(reference_fem::make_fem_fitted());
      list.push_back(reference_fem::make_fem_cut());
      list.push_back(make_external());
      return list;
    }

    /** These, and those of plugins after them. */
    MethodList &registry()
    {
      static MethodList list = methods_of_this_program();
      return list;
    }

    std::vector<std::string> &added_files()
    {
      static std::vector<std::string> files;
      return files;
    }
  } // namespace

  const MethodList &methods()
  {
    return registry();
  }

  void add_plugins(const std::vector<std::string> &files)
  {
    for(const std::string &file : files)
    {
      add_plugin(file, registry());
      added_files().push_back(std::filesystem::absolute(file).string());
    }
  }

  const std::vector<std::string> &plugin_files()
  {
    return added_files();
  }

  const cases::Method &method_named(const std::string &name)
  {
    std::vector<std::string> names;
    for(const auto &method : methods())
    {
      if(method->name() == name)
        return *method;
      names.push_back(method->name());
    }
    throw cases::InputError(fmt::format("there is no method '{}'; the nearest is '{}'",
                                        name, cases::nearest_name(name, names)));
  }
} // namespace meltfront::verification
