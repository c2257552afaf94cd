#include <cases/error.h>
#include <verification/studies/crosscheck/shrink.h>

#include <gtest/gtest.h>

namespace meltfront::verification
{
  namespace
  {
    SceneDraft full_draft()
    {
      SceneDraft draft;
      draft.set("", "title", "A scene");
      draft.set("Scene", "end time", "8");
      draft.set("Scene/Walls/x_min", "kind", "flux");
      draft.set("Scene/Walls/x_min", "flux", "if(t < 1, 5, 0)", {"0", "5"});
      draft.set("Scene/Material/Solid", "conductivity", "1");
      draft.set("Scene/Material/Liquid", "conductivity", "7");
      draft.set("Scene/Material/Liquid", "density", "2");
      draft.set("Scene/Walls/x_max", "kind", "insulated");
      return draft;
    }

    TEST(SceneDraft, WritesEachSubsectionOnce)
    {
      SceneDraft draft = full_draft();
      draft.set("Scene/Material/Solid", "density", "3");
      EXPECT_EQ(draft.text("two\n\nlines"), R"(# two
#
# lines
set title = A scene
subsection Scene
  set end time = 8
  subsection Walls
    subsection x_min
      set kind = flux
      set flux = if(t < 1, 5, 0)
    end
    subsection x_max
      set kind = insulated
    end
  end
  subsection Material
    subsection Solid
      set conductivity = 1
      set density = 3
    end
    subsection Liquid
      set conductivity = 7
      set density = 2
    end
  end
end
)");
    }

    TEST(Shrink, KeepsTheContradictionAndNothingElse)
    {
      const auto shows = [](const SceneDraft &draft)
      {
        if(!draft.has("Scene/Walls/x_min"))
          throw cases::InputError("no case");
        return !draft.value("Scene/Material/Liquid", "conductivity").empty()
               && draft.value("Scene/Walls/x_min", "flux") != "0";
      };
      ShrinkBudget budget;
      budget.trials = 30;
      SceneDraft smallest = shrunk(full_draft(), shows, budget);
      EXPECT_TRUE(shows(smallest));
      EXPECT_EQ(smallest.value("Scene/Material/Liquid", "density"), "");
      EXPECT_EQ(smallest.value("Scene/Walls/x_min", "flux"), "5");
      EXPECT_FALSE(smallest.has("Scene/Walls/x_max"));
    }

    TEST(Shrink, SpendsNoMoreThanItsBudget)
    {
      int trials = 0;
      ShrinkBudget budget;
      budget.trials = 3;
      const auto shows = [&trials](const SceneDraft &) { return ++trials > 0; };
      shrunk(full_draft(), shows, budget);
      EXPECT_EQ(trials, 3);
    }

    TEST(Shrink, LeavesWhatCannotBeSimplerAsItIs)
    {
      const SceneDraft draft = full_draft();
      EXPECT_EQ(shrunk(draft, [](const SceneDraft &) { return false; }).text(),
                draft.text());
    }
  } // namespace
} // namespace meltfront::verification
