#pragma once
#include <memory>
#include <string>

#include "render/snapshot.hpp"
#include "report/canvas.hpp"

typedef struct _cairo cairo_t;
typedef struct _cairo_surface cairo_surface_t;

namespace ream::report {

/// How a paragraph looks.
struct Type {
  double size = 9.0;
  Ink ink = grey(0.1);
  bool bold = false;
  Anchor anchor = Anchor::left;
};

/// A4 pages, one after the other, drawn with cairo; points from the top left corner.
class PdfSheet final : public Canvas {
 public:
  static constexpr double page_width = 595.28, page_height = 841.89;

  /// A document about something on some day (ISO, may be empty).
  PdfSheet(const std::string& title, const std::string& created_utc);
  /// Nothing is kept: for finding out how much room things take.
  PdfSheet();
  ~PdfSheet() override;
  PdfSheet(const PdfSheet&) = delete;
  PdfSheet& operator=(const PdfSheet&) = delete;

  void next_page();
  /// Ends the document. Error unavailable when drawing failed.
  std::string bytes();

  /// Broken into lines of that width; `top` is the upper edge of the first. Returns its height.
  double paragraph(double left, double top, double width, const std::string& words, const Type& type);
  double height_of(double width, const std::string& words, const Type& type);
  void image(const render::Image& image, double left, double top, double width, double height);
  void box(double left, double top, double width, double height, const Stroke& stroke);
  /// A field of slanted dark lines, as hatched surfaces are drawn.
  void hatch(double left, double top, double width, double height);

  void fill(std::span<const Place> polygon, const Ink& ink) override;
  void line(std::span<const Place> path, const Stroke& stroke) override;
  void text(const Place& at, const std::string& words, const Lettering& lettering) override;

 private:
  struct Free {
    void operator()(cairo_t* context) const;
    void operator()(cairo_surface_t* surface) const;
  };
  void begin();
  void trace_path(std::span<const Place> path);
  void set_ink(const Ink& ink);

  std::string bytes_;
  std::unique_ptr<cairo_surface_t, Free> surface_;
  std::unique_ptr<cairo_t, Free> context_;
};

}  // namespace ream::report
