#include <cases/error.h>
#include <verification/report/page/report.h>
#include <verification/report/tests/fixture.h>
#include <verification/report/tests/well_formed.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace meltfront::verification
{
  namespace
  {
    void expect_unique_identifiers(const std::string &html)
    {
      static const std::regex identifier("\\sid=[\"']([^\"']*)[\"']");
      std::set<std::string> seen;
      for(std::sregex_iterator i(html.begin(), html.end(), identifier), end; i != end;
          ++i)
        EXPECT_TRUE(seen.insert((*i)[1]).second) << (*i)[1];
      EXPECT_GT(seen.size(), 10u);
      static const std::regex reference("href=[\"']#([^\"']*)[\"']");
      for(std::sregex_iterator i(html.begin(), html.end(), reference), end; i != end; ++i)
        EXPECT_TRUE(seen.count((*i)[1])) << (*i)[1];
    }

    void expect_self_contained(const std::string &html)
    {
      for(const char *outside :
          {"http:", "https:", "src=", "<script", "<link", "@import", "url("})
        EXPECT_EQ(html.find(outside), std::string::npos) << outside;
    }

    std::string report_of(const MatrixResult &result)
    {
      const fixture::Directory directory;
      write_report(result, directory.path());
      const std::string html = directory.read("report.html");
      EXPECT_EQ(fixture::first_mistake(html), "");
      expect_self_contained(html);
      expect_unique_identifiers(html);
      return html;
    }

    std::size_t position(const std::string &html, const std::string &what)
    {
      const std::size_t found = html.find(what);
      EXPECT_NE(found, std::string::npos) << what;
      return found;
    }
  } // namespace

  TEST(WellFormed, TheCheckItselfFindsMistakes)
  {
    EXPECT_EQ(fixture::first_mistake("<!DOCTYPE html>\n<p a=\"1\" b='2'>x<br/>&amp;</p>"),
              "");
    for(const char *broken :
        {"<p>", "<p></b>", "</p>", "<p>a & b</p>", "<p>1 < 2</p>", "<p a=1></p>",
         "<p a=\"1\" a=\"2\"></p>", "<b><p></b></p>", "<p a=\"<\"></p>", "<p"})
      EXPECT_NE(fixture::first_mistake(broken), "") << broken;
  }

  TEST(Report, ChaptersStandInTheirOrder)
  {
    const std::string html = report_of(fixture::matrix());
    std::size_t last = 0;
    for(const char *anchor :
        {"id=\"verdict\"", "id=\"stability\"", "id=\"cost\"", "id=\"effects\"",
         "id=\"case-plane\"", "id=\"case-sink\"", "id=\"provenance\""})
    {
      const std::size_t next = position(html, anchor);
      EXPECT_GT(next, last) << anchor;
      last = next;
    }
  }

  TEST(Report, SaysWhatHoldsWhatFailsAndWhatIsMissing)
  {
    const std::string html = report_of(fixture::matrix());
    position(html, "1 of 2 acceptance criteria hold");
    position(html, "expected failure: 1.5 &lt;measured&gt; &amp; known");
    position(html, "temperature is &lt;not&gt; finite &amp; &#39;broken&#39;");
    position(html, "fem-enthalpy lacks the effect &quot;liquid_motion&quot;");
    position(html, "1 of 3 hard runs failed");
    position(html, "not reached");
    position(html, "the floor of 3\u00b710<sup>\u22125</sup> m");
    EXPECT_EQ(html.find("<freezing>"), std::string::npos);
  }

  TEST(Report, EveryCaseHasItsTablesAndPlots)
  {
    const fixture::Directory directory;
    write_report(fixture::matrix(), directory.path());
    for(const char *name : {"plane", "sink"})
    {
      for(const char *ending : {".csv", ".md", ".tex"})
        EXPECT_TRUE(directory.has(std::string("tables/") + name + ending))
            << name << ending;
      for(const char *plot : {"-scene", "-error-spacing", "-error-cost", "-front",
                              "-front-error", "-temperature", "-budget"})
      {
        const std::string svg
            = directory.read(std::string("plots/") + name + plot + ".svg");
        EXPECT_EQ(svg.rfind("<?xml", 0), 0u) << name << plot;
      }
    }
    EXPECT_TRUE(directory.has("tables/sink-printed.csv"));
    EXPECT_TRUE(directory.has("tables/what-accuracy-costs.csv"));
  }

  TEST(Report, IsTheSameEachTime)
  {
    EXPECT_EQ(report_of(fixture::matrix()), report_of(fixture::matrix()));
  }

  TEST(Report, MatrixWithoutAFinishedRun)
  {
    MatrixResult result = fixture::matrix();
    for(RunRecord &run : result.runs)
    {
      const std::string case_name = run.case_name, label = run.label;
      const int n = run.n;
      run = RunRecord();
      run.case_name = case_name;
      run.label = run.method = label;
      run.n = n;
      run.message = "it broke";
    }
    const std::string html = report_of(result);
    position(html,
             "No finished run can be compared with an exact solution or a reference.");
    position(html, "it broke");
  }

  TEST(Report, EmptyMatrix)
  {
    const std::string html = report_of(MatrixResult());
    position(html, "No acceptance criterion was set");
  }

  TEST(Report, CasesWithoutRuns)
  {
    MatrixResult result = fixture::matrix();
    result.runs.clear();
    position(report_of(result), "No run of this case is in the matrix.");
  }

  TEST(Report, OneResolutionOnly)
  {
    MatrixResult result = fixture::matrix();
    std::erase_if(result.runs, [](const RunRecord &run) { return run.n != 40; });
    report_of(result);
  }

  TEST(Report, NothingIsANumber)
  {
    MatrixResult result = fixture::matrix();
    const double nan = std::nan("");
    for(RunRecord &run : result.runs)
    {
      for(auto &[name, value] : run.quantities)
        value = nan;
      for(auto *series : {&run.series.time, &run.series.front, &run.series.front_exact,
                          &run.series.budget_defect, &run.profile.temperature,
                          &run.profile.coordinate, &run.profile.picture_x})
        for(double &value : *series)
          value = nan;
      run.cost = cases::Cost();
      run.cost.setup_cpu = run.cost.stepping_wall = nan;
      run.description.spacing = nan;
    }
    for(StoredCase &record : result.cases)
    {
      cases::Material &material = record.scene.material;
      record.scene.end_time = material.melting_temperature = nan;
      material.solid.density = material.liquid.conductivity = nan;
    }
    report_of(result);
  }

  TEST(Report, CaseWithoutExactSolution)
  {
    MatrixResult result = fixture::matrix();
    for(StoredCase &record : result.cases)
      record.exact = nullptr;
    for(RunRecord &run : result.runs)
    {
      run.series.front_exact.clear();
      run.profile.temperature_exact.clear();
      run.quantities.erase("front_rms");
    }
    position(report_of(result), "There is no exact solution");
  }

  TEST(Report, BallsAndSpheres)
  {
    MatrixResult result = fixture::matrix();
    for(StoredCase &record : result.cases)
    {
      record.scene.symmetry = cases::Symmetry::spherical;
      record.scene.domain = {cases::DomainShape::ball, 3, {}, {}, 0.5};
      record.scene.boundaries = {};
      record.scene.boundaries[static_cast<std::size_t>(cases::Side::outer)]
          = cases::Boundary{cases::BoundaryKind::fixed_temperature, {}, true};
    }
    report_of(result);
  }

  TEST(Report, UnwritableDirectoryIsAnOutputError)
  {
    const fixture::Directory directory;
    std::ofstream(directory.path() + "/file") << "in the way";
    EXPECT_THROW(write_report(fixture::matrix(), directory.path() + "/file"),
                 cases::OutputError);
  }

  TEST(RunPage, FrontOverTimeAndPicture)
  {
    const fixture::Directory directory;
    const RunRecord run = fixture::run("plane", "sph", 40, 1, 1, 1);
    write_run_page(run, fixture::plane_case("plane"), directory.path() + "/new");
    std::stringstream csv(directory.read("new/front.csv"));
    std::string line;
    std::getline(csv, line);
    EXPECT_EQ(line, "time,front,front_isotherm,front_exact,budget_defect,solid_volume");
    std::getline(csv, line);
    EXPECT_EQ(line, "0,0.025,nan,0,0,nan");
    int rows = 1;
    while(std::getline(csv, line))
      ++rows;
    EXPECT_EQ(rows, 61);
    EXPECT_NE(directory.read("new/picture.svg").find("</svg>"), std::string::npos);
  }

  TEST(RunPage, AFailedRunHasAPageToo)
  {
    const fixture::Directory directory;
    write_run_page(RunRecord(), fixture::sink_case("sink"), directory.path());
    EXPECT_TRUE(directory.has("front.csv"));
    EXPECT_TRUE(directory.has("picture.svg"));
  }

  TEST(RunPage, SitesOfThePlaneAreDrawnByPhase)
  {
    const fixture::Directory directory;
    const MatrixResult result = fixture::matrix();
    for(const RunRecord &run : result.runs)
      if(!run.profile.picture_x.empty())
        write_run_page(run, result.cases[1], directory.path());
    const std::string svg = directory.read("picture.svg");
    const auto count = [&svg](const std::string &what)
    {
      int found = 0;
      for(std::size_t at = svg.find(what); at != std::string::npos;
          at = svg.find(what, at + 1))
        ++found;
      return found;
    };
    int solid = 0;
    for(const RunRecord &run : result.runs)
      if(!run.profile.picture_x.empty() && run.seed == 2)
        for(const double fraction : run.profile.picture_solid_fraction)
          solid += fraction >= 0.5;
    EXPECT_EQ(count("<use xlink:href='#gpPt6' transform"), solid);
    EXPECT_EQ(count("<use xlink:href='#gpPt5' transform"), 1600 - solid);
  }
} // namespace meltfront::verification
