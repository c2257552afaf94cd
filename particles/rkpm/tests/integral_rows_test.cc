#include "integral_scenes.h"

#include <cases/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::particles
{
  namespace
  {
    using namespace integral_scenes;
    constexpr double pi = std::numbers::pi;

    TEST(Scratch, Figures)
    {
      for(int policy = 0; policy < 4; ++policy)
        for(const char *name : {"cubic_spline", "wendland_c4", "epanechnikov"})
          for(int order : {3, 4})
            for(bool enlarge : {true, false})
              for(int flux : {0, 2})
          {
            if(enlarge == (policy > 0))
              continue;
            printf("%s %s K=%d enlarge=%d flux=%d:", weight_policy_names()[policy].c_str(), name,
                   order, enlarge, flux);
            for(int n : {15, 30, 60, 120})
            {
              const Particles p = arrange(1, n, -pi, pi, 0, 1, flux);
              IntegralParameters q;
              q.kernel = kernel_shape(name);
              q.weights = WeightPolicy(policy);
              q.order = order;
              q.enlarge = enlarge;
              try {
              printf(" %.2e", poisson_error(p, q, sine()));
              } catch(std::exception &e) { printf(" %s", e.what());}
            }
            printf("\n");
          }
    }
  } // namespace
} // namespace meltfront::particles
