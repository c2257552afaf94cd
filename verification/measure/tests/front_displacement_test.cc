#include <cases/exact/manufactured/manufactured_solution.h>
#include <verification/measure/formulas/front_displacement.h>
#include <verification/measure/tests/fixtures.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::verification
{
  namespace
  {
    using tests::State;

    /** An ellipse, and a lattice of cells whose solid fractions are those of the same
     * ellipse moved by `shift` to the right, sampled finely. */
    class MovedEllipse
    {
    public:
      explicit MovedEllipse(double shift)
        : exact(cases::Material{},
                cases::make_front_family({.name = "ellipse", .dimension = 2}), 1)
      {
        constexpr int cells = 80, parts = 16;
        const double width = 2. / cells;
        for(int i = 0; i < cells; ++i)
          for(int j = 0; j < cells; ++j)
          {
            int solid = 0;
            for(int k = 0; k < parts * parts; ++k)
              solid += exact.level_set(
                           {-1 + (i + (k % parts + 0.5) / parts) * width - shift,
                            -1 + (j + (k / parts + 0.5) / parts) * width, 0},
                           0)
                       < 0;
            state.positions[0].push_back(-1 + (i + 0.5) * width);
            state.positions[1].push_back(-1 + (j + 0.5) * width);
            state.weights.push_back(width * width);
            state.temperature.push_back(0);
            state.solid_fraction.push_back(double(solid) / (parts * parts));
          }
      }

      FrontDisplacement displacement()
      {
        return front_displacement(state.view(2, 0), exact);
      }

      cases::ManufacturedSolution exact;
      State state;
    };

    TEST(FrontDisplacement, IsNoneOfTheExactFront)
    {
      const FrontDisplacement found = MovedEllipse(0).displacement();
      EXPECT_NEAR(found.mean, 0, 1e-4);
      EXPECT_NEAR(found.mismatch, 0, 1e-14);
    }

    TEST(FrontDisplacement, SeesAMoveThatKeepsTheVolume)
    {
      // What is in the wrong phase is the shift times the height, on either side.
      const double shift = 0.02, height = 2 * 0.25, perimeter = 2.069313803611441;
      const FrontDisplacement found = MovedEllipse(shift).displacement();
      EXPECT_NEAR(found.mean, 0, 1e-4);
      EXPECT_NEAR(found.mismatch, 2 * shift * height / perimeter, 1e-4);
    }
  } // namespace
} // namespace meltfront::verification
