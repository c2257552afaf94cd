#include <cases/data_folder.h>
#include <cases/error.h>
#include <verification/app/manual/markdown.h>

#include <cmark-gfm-core-extensions.h>
#include <cmark-gfm.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <vector>

namespace meltfront::verification
{
  namespace
  {
    struct FreeNode
    {
      void operator()(cmark_node *node) const
      {
        cmark_node_free(node);
      }
    };
    using Document = std::unique_ptr<cmark_node, FreeNode>;

    Document parsed(const std::string &source)
    {
      cmark_gfm_core_extensions_ensure_registered();
      const std::unique_ptr<cmark_parser, void (*)(cmark_parser *)> parser(
          cmark_parser_new(CMARK_OPT_DEFAULT), cmark_parser_free);
      cmark_parser_attach_syntax_extension(parser.get(),
                                           cmark_find_syntax_extension("table"));
      cmark_parser_feed(parser.get(), source.data(), source.size());
      return Document(cmark_parser_finish(parser.get()));
    }

    std::vector<cmark_node *> nodes_of(cmark_node *document)
    {
      std::vector<cmark_node *> nodes;
      const std::unique_ptr<cmark_iter, void (*)(cmark_iter *)> iterator(
          cmark_iter_new(document), cmark_iter_free);
      while(cmark_iter_next(iterator.get()) != CMARK_EVENT_DONE)
        if(cmark_iter_get_event_type(iterator.get()) == CMARK_EVENT_ENTER)
          nodes.push_back(cmark_iter_get_node(iterator.get()));
      return nodes;
    }

    bool leads_elsewhere(const std::string &address)
    {
      return address.starts_with("http://") || address.starts_with("https://")
             || address.starts_with("#");
    }

    /** What a link shows, in its place. */
    void unwrap(cmark_node *link)
    {
      while(cmark_node *child = cmark_node_first_child(link))
        cmark_node_insert_before(link, child);
      cmark_node_free(link);
    }

    void replace_all_in(std::string &text, const std::string &what, const std::string &by)
    {
      for(std::size_t at = text.find(what); at != std::string::npos;
          at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
    }
  } // namespace

  Markup markdown(const std::string &source, int level, bool with_title)
  {
    const Document document = parsed(source);
    cmark_node *first = cmark_node_first_child(document.get());
    if(!with_title && first && cmark_node_get_type(first) == CMARK_NODE_HEADING)
      cmark_node_free(first);
    for(cmark_node *node : nodes_of(document.get()))
    {
      const cmark_node_type type = cmark_node_get_type(node);
      if(type == CMARK_NODE_HEADING)
        cmark_node_set_heading_level(
            node, std::min(cmark_node_get_heading_level(node) + level - 1, 6));
      else if(type == CMARK_NODE_IMAGE)
        cmark_node_free(node);
      else if(type == CMARK_NODE_LINK && !leads_elsewhere(cmark_node_get_url(node)))
        unwrap(node);
    }
    const std::unique_ptr<char, void (*)(void *)> rendered(
        cmark_render_html(document.get(), CMARK_OPT_DEFAULT, nullptr), std::free);
    std::string html = rendered.get();
    replace_all_in(html, "<table>", "<div class=\"scroll plain\"><table>");
    replace_all_in(html, "</table>", "</table></div>");
    return Markup(html);
  }

  std::string source_text(const std::string &path)
  {
    const std::string full = cases::data_path(path);
    std::ifstream in(full, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if(!in || text.empty())
      throw cases::OutputError(
          fmt::format("{}: cannot be read, and the manual needs it", full));
    return text;
  }
} // namespace meltfront::verification
