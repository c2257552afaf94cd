#include <verification/report/chapters/variation_group.h>
#include <verification/report/page/case_runs.h>
#include <verification/report/page/report.h>
#include <verification/report/plots/variation_plots.h>
#include <verification/report/tests/fixture.h>
#include <verification/report/tests/well_formed.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    cases::Criterion order_of_front(double lower)
    {
      cases::Criterion criterion;
      criterion.method = "sph";
      criterion.quantity = "front_rms";
      criterion.statistic = cases::Statistic::order;
      criterion.lower = lower;
      return criterion;
    }

    /** A slab varied by latent heat and conductivity, with errors of a known order; the
     * runs of the poor conductor note that they do not resolve it. */
    MatrixResult varied()
    {
      MatrixResult result;
      result.name = "varied";
      for(const double latent_heat : {10., 1.})
        for(const double conductivity : {0.1, 1.})
        {
          StoredCase record = fixture::plane_case(
              "slab[conductivity=" + std::to_string(conductivity)
              + ",latent_heat=" + std::to_string(latent_heat) + "]");
          record.variation_of = "slab";
          record.variation
              = {{"Scene/Material/latent heat", std::to_string(latent_heat)},
                 {"Scene/Material/Solid/conductivity", std::to_string(conductivity)}};
          record.scene.material.latent_heat = latent_heat;
          record.scene.material.solid.conductivity = conductivity;
          record.scene.material.liquid.conductivity = 1;
          for(const int n : {20, 40, 80, 160})
          {
            RunRecord run = fixture::run(record.name(), "sph", n, 0.5,
                                         conductivity < 1 ? 1.5 : 2, 0.01);
            if(conductivity < 1)
              run.events = {{0.1, "layer <thin>: 3 at n = " + std::to_string(n)}};
            result.runs.push_back(run);
          }
          result.cases.push_back(record);
        }
      return result;
    }

    std::string report_of(const MatrixResult &result, std::string *csv = nullptr)
    {
      const fixture::Directory directory;
      write_report(result, directory.path());
      const std::string html = directory.read("report.html");
      EXPECT_EQ(fixture::first_mistake(html), "");
      if(csv)
        *csv = directory.read("tables/slab-latent_heat-conductivity.csv");
      return html;
    }

    bool holds(const std::string &text, const std::string &part)
    {
      return text.find(part) != std::string::npos;
    }
  } // namespace

  TEST(Variations, AreGroupedByWhatIsVaried)
  {
    MatrixResult result = varied();
    result.cases.push_back(result.cases.front());
    result.cases.back().variation.pop_back();
    const std::vector<CaseRuns> runs = collect_runs(result);
    const std::vector<VariationGroup> groups = variation_groups(runs);
    ASSERT_EQ(groups.size(), 2u);
    EXPECT_EQ(groups[0].variations.size(), 4u);
    ASSERT_EQ(groups[0].axes.size(), 2u);
    EXPECT_EQ(groups[0].axes[0].heading, "Stefan number");
    EXPECT_EQ(groups[0].axes[0].values, (std::vector<std::string>{"0.1", "1"}));
    EXPECT_EQ(groups[0].axes[1].heading, "k_s/k_l");
    EXPECT_EQ(groups[0].axes[1].values, (std::vector<std::string>{"0.1", "1"}));
    EXPECT_EQ(groups[0].variations[2].place, (std::vector<std::size_t>{1, 0}));
    EXPECT_EQ(groups[0].labels, (std::vector<std::string>{"sph"}));
  }

  TEST(Variations, ThePecletNumberIsSpeedTimesSpacingOverDiffusivity)
  {
    StoredCase record = fixture::plane_case("slab");
    record.scene.material.solid = {0.5, 2, 5}; // diffusivity 0.05
    record.scene.material.liquid = {1, 1, 1};
    RunRecord run;
    run.description.spacing = 0.1;
    run.series.time = {0, 1, 2};
    run.series.front = {0, 9, 18};
    EXPECT_NEAR(front_peclet_number(record, run), 9 * 0.1 / 0.05, 1e-12);
    run.series.front_exact = {0.1, 0.3, 0.4};
    EXPECT_NEAR(front_peclet_number(record, run), 0.2 * 0.1 / 0.05, 1e-12);
    run.series = {};
    EXPECT_TRUE(std::isnan(front_peclet_number(record, run)));
  }

  TEST(Variations, HaveATableWithTheirWarningsAndNoChapters)
  {
    std::string csv;
    const std::string html = report_of(varied(), &csv);
    EXPECT_TRUE(holds(html, "id=\"variations\""));
    EXPECT_TRUE(holds(html, "slab by Stefan number and k_s/k_l"));
    EXPECT_TRUE(holds(html, "layer &lt;thin&gt;"));
    EXPECT_TRUE(holds(html, "(1)\u00a0n\u00a0=\u00a020,\u00a040,\u00a080,\u00a0160"));
    EXPECT_FALSE(holds(html, "id=\"case-slab"));
    EXPECT_FALSE(holds(html, "id=\"findings\"") && holds(html, "What the runs show"));
    EXPECT_TRUE(csv.starts_with("case,Stefan number,k_s/k_l,method,n,h,dt,front_rms,"));
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 17);
    EXPECT_TRUE(holds(csv, "layer <thin>: 3 at n = 160"));
  }

  TEST(Variations, TheMapHoldsErrorOrderAndWhatKeepsFromOne)
  {
    MatrixResult result = varied();
    for(RunRecord &run : result.runs)
      if(run.case_name == result.cases.front().name())
        run.quantities["front_rms"] = 0.02; // stagnates
    const std::vector<CaseRuns> runs = collect_runs(result);
    const std::vector<VariationGroup> groups = variation_groups(runs);
    const std::string script = variation_map_script(groups.at(0), "sph");
    EXPECT_TRUE(holds(script, "'h^{2.00}'"));
    EXPECT_TRUE(holds(script, "'h^{1.50}'"));
    EXPECT_TRUE(holds(script, "stagnating"));
    EXPECT_TRUE(holds(script, "'0.05'")); // 0.02 over the front at 0.4
    const Plot plot = error_against_peclet(groups.at(0), "sph");
    ASSERT_EQ(plot.curves.size(), 2u);
    EXPECT_EQ(plot.curves[0].x.size(), 8u);
    EXPECT_EQ(plot.curves[1].label, "1");
  }

  TEST(FindingsChapter, SaysInWordsWhatIsMeasuredAndWhatNoLongerHolds)
  {
    MatrixResult result = varied();
    const cases::Criterion good = order_of_front(1.4), bad = order_of_front(1.8);
    result.claims
        = {{"The <order> is {1}.", {{"slab[conductivity=*,latent_heat=*]", good}}},
           {"It is two: {1}.", {{"slab[conductivity=*,latent_heat=*]", bad}}},
           {"Nothing {1}.", {{"rod", bad}}}};
    result.findings = judge_findings(result, result.claims);
    result.pictures = {{"A <caption>.",
                        "slab[conductivity=*,latent_heat=*]",
                        {"sph"},
                        "front_rms",
                        "h"}};
    const std::string html = report_of(result);
    EXPECT_TRUE(holds(html, "The &lt;order&gt; is 1.5 to 2."));
    EXPECT_TRUE(holds(html, "holds</span> The"));
    EXPECT_TRUE(holds(html, "not borne out by this run</span> It is two: 1.5 to 2."));
    EXPECT_TRUE(holds(html, "not measured"));
    EXPECT_TRUE(holds(html, "1 of 3 findings hold"));
    EXPECT_TRUE(holds(html, "A &lt;caption&gt;."));
    // The cases that break the second one are named.
    EXPECT_TRUE(holds(html, result.cases[0].name() + ": 1.5"));
    EXPECT_FALSE(holds(html, result.cases[1].name() + ": 2"));
  }
} // namespace meltfront::verification
