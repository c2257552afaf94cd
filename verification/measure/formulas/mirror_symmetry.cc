#include <verification/measure/formulas/mirror_symmetry.h>
#include <verification/measure/formulas/site_grid.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::verification
{
  namespace
  {
    /** In spacings: a site this near to an image is its site. */
    constexpr double image_tolerance = 1e-6;
  } // namespace

  MirrorSymmetry::MirrorSymmetry(int direction, double spacing)
    : direction(direction)
    , spacing(spacing)
    , sites(cases::Symmetry::planar)
  {
  }

  void MirrorSymmetry::find_images(const cases::Snapshot &snapshot)
  {
    image.clear();
    const SiteGrid grid(snapshot, spacing / 2);
    const double reach = image_tolerance * spacing;
    for(std::size_t i = 0; i < snapshot.temperature.size(); ++i)
    {
      cases::Position mirrored = site_position(snapshot, i);
      mirrored[direction] = -mirrored[direction];
      const std::size_t found = image.size();
      grid.visit(mirrored,
                 [&](std::uint32_t j)
                 {
                   const cases::Position other = site_position(snapshot, j);
                   double farthest = 0;
                   for(int d = 0; d < 3; ++d)
                     farthest = std::max(farthest, std::abs(other[d] - mirrored[d]));
                   if(farthest <= reach && image.size() == found)
                     image.push_back(j);
                 });
      if(image.size() == found)
      {
        image.clear();
        return;
      }
    }
  }

  double MirrorSymmetry::largest_difference(const cases::Snapshot &snapshot)
  {
    sites.of(snapshot);
    if(sites.version() != images_version)
    {
      images_version = sites.version();
      find_images(snapshot);
    }
    if(image.empty())
      return std::numeric_limits<double>::quiet_NaN();
    double largest = 0;
    for(std::size_t i = 0; i < image.size(); ++i)
      largest = std::max(
          largest, std::abs(snapshot.temperature[i] - snapshot.temperature[image[i]]));
    return largest;
  }
} // namespace meltfront::verification
