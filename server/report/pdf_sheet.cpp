#include "report/pdf_sheet.hpp"

#include <cairo-pdf.h>
#include <cairo.h>
#include <pango/pangocairo.h>

#include <cmath>
#include <vector>

#include "core/error.hpp"

namespace ream::report {
namespace {

/// The first of these that there is; the last one covers every letter.
constexpr const char* font_family = "Inter, Liberation Sans, DejaVu Sans, sans-serif";

struct FreeObject {
  void operator()(PangoLayout* layout) const { g_object_unref(layout); }
};
using Layout = std::unique_ptr<PangoLayout, FreeObject>;

cairo_status_t append(void* to, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

Layout layout_of(cairo_t* context, const std::string& words, double size, bool bold) {
  Layout layout(pango_cairo_create_layout(context));
  PangoFontDescription* font = pango_font_description_from_string(font_family);
  pango_font_description_set_absolute_size(font, size * PANGO_SCALE);
  pango_font_description_set_weight(font, bold ? PANGO_WEIGHT_SEMIBOLD : PANGO_WEIGHT_NORMAL);
  pango_layout_set_font_description(layout.get(), font);
  pango_font_description_free(font);
  pango_layout_set_text(layout.get(), words.c_str(), static_cast<int>(words.size()));
  return layout;
}

Layout paragraph_of(cairo_t* context, double width, const std::string& words, const Type& type) {
  Layout layout = layout_of(context, words, type.size, type.bold);
  pango_layout_set_width(layout.get(), static_cast<int>(width * PANGO_SCALE));
  pango_layout_set_wrap(layout.get(), PANGO_WRAP_WORD_CHAR);
  constexpr PangoAlignment alignments[] = {PANGO_ALIGN_LEFT, PANGO_ALIGN_CENTER, PANGO_ALIGN_RIGHT};
  pango_layout_set_alignment(layout.get(), alignments[static_cast<size_t>(type.anchor)]);
  pango_layout_set_line_spacing(layout.get(), 1.05f);
  return layout;
}

double height_of_layout(PangoLayout* layout) {
  int height = 0;
  pango_layout_get_size(layout, nullptr, &height);
  return static_cast<double>(height) / PANGO_SCALE;
}

}  // namespace

void PdfSheet::Free::operator()(cairo_t* context) const { cairo_destroy(context); }
void PdfSheet::Free::operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }

PdfSheet::PdfSheet(const std::string& title, const std::string& created_utc)
    : surface_(cairo_pdf_surface_create_for_stream(append, &bytes_, page_width, page_height)) {
  cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
  cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_CREATOR, "ream");
  const std::string day = created_utc.empty() ? "1970-01-01T00:00:00Z" : created_utc;
  cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_CREATE_DATE, day.c_str());
  begin();
}

PdfSheet::PdfSheet() : surface_(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, nullptr)) {
  begin();
}

PdfSheet::~PdfSheet() = default;

void PdfSheet::begin() {
  context_.reset(cairo_create(surface_.get()));
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context_.get(), options);
  cairo_font_options_destroy(options);
}

void PdfSheet::next_page() { cairo_show_page(context_.get()); }

std::string PdfSheet::bytes() {
  cairo_show_page(context_.get());
  const cairo_status_t drawn = cairo_status(context_.get());
  context_.reset();
  cairo_surface_finish(surface_.get());
  const cairo_status_t finished = cairo_surface_status(surface_.get());
  for (const cairo_status_t status : {drawn, finished})
    if (status != CAIRO_STATUS_SUCCESS)
      throw Error(ErrorKind::unavailable,
                  std::string("report: the PDF cannot be drawn: ") + cairo_status_to_string(status));
  return std::move(bytes_);
}

void PdfSheet::set_ink(const Ink& ink) { cairo_set_source_rgb(context_.get(), ink.red, ink.green, ink.blue); }

double PdfSheet::paragraph(double left, double top, double width, const std::string& words,
                           const Type& type) {
  const Layout layout = paragraph_of(context_.get(), width, words, type);
  set_ink(type.ink);
  cairo_move_to(context_.get(), left, top);
  pango_cairo_show_layout(context_.get(), layout.get());
  return height_of_layout(layout.get());
}

double PdfSheet::height_of(double width, const std::string& words, const Type& type) {
  return height_of_layout(paragraph_of(context_.get(), width, words, type).get());
}

void PdfSheet::image(const render::Image& image, double left, double top, double width, double height) {
  std::vector<uint32_t> pixels(image.rgba.size() / 4);
  for (size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = 0xff000000u | static_cast<uint32_t>(image.rgba[4 * i]) << 16 |
                static_cast<uint32_t>(image.rgba[4 * i + 1]) << 8 | image.rgba[4 * i + 2];
  const std::unique_ptr<cairo_surface_t, Free> picture(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height));
  cairo_surface_flush(picture.get());
  unsigned char* rows = cairo_image_surface_get_data(picture.get());
  const auto stride = static_cast<size_t>(cairo_image_surface_get_stride(picture.get()));
  const size_t row_bytes = 4 * static_cast<size_t>(image.width);
  for (size_t y = 0; rows != nullptr && y < static_cast<size_t>(image.height); ++y)
    std::copy_n(reinterpret_cast<const unsigned char*>(pixels.data()) + y * row_bytes, row_bytes,
                rows + y * stride);
  cairo_surface_mark_dirty(picture.get());
  cairo_save(context_.get());
  cairo_translate(context_.get(), left, top);
  cairo_scale(context_.get(), width / image.width, height / image.height);
  cairo_set_source_surface(context_.get(), picture.get(), 0, 0);
  cairo_paint(context_.get());
  cairo_restore(context_.get());
}

void PdfSheet::box(double left, double top, double width, double height, const Stroke& stroke) {
  const Place corners[] = {
      {left, top}, {left + width, top}, {left + width, top + height}, {left, top + height}, {left, top}};
  line(corners, stroke);
}

void PdfSheet::hatch(double left, double top, double width, double height) {
  cairo_save(context_.get());
  cairo_rectangle(context_.get(), left, top, width, height);
  cairo_clip(context_.get());
  for (double x = left - height; x < left + width; x += 4.0)
    straight({x, top + height}, {x + height, top}, {1.0, grey(0.2), false});
  cairo_restore(context_.get());
}

void PdfSheet::trace_path(std::span<const Place> path) {
  cairo_new_path(context_.get());
  for (const Place& place : path) cairo_line_to(context_.get(), place.x, place.y);
}

void PdfSheet::fill(std::span<const Place> polygon, const Ink& ink) {
  trace_path(polygon);
  set_ink(ink);
  cairo_close_path(context_.get());
  cairo_fill(context_.get());
}

void PdfSheet::line(std::span<const Place> path, const Stroke& stroke) {
  constexpr double dashes[] = {3.0, 2.0};
  trace_path(path);
  set_ink(stroke.ink);
  cairo_set_line_width(context_.get(), stroke.width);
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_dash(context_.get(), dashes, stroke.dashed ? 2 : 0, 0.0);
  cairo_stroke(context_.get());
}

void PdfSheet::text(const Place& at, const std::string& words, const Lettering& lettering) {
  const Layout layout = layout_of(context_.get(), words, lettering.size, lettering.bold);
  int width = 0;
  pango_layout_get_size(layout.get(), &width, nullptr);
  const double share = lettering.anchor == Anchor::left     ? 0.0
                       : lettering.anchor == Anchor::middle ? 0.5
                                                            : 1.0;
  cairo_save(context_.get());
  cairo_translate(context_.get(), at.x, at.y);
  if (lettering.upwards) cairo_rotate(context_.get(), -0.5 * M_PI);
  set_ink(lettering.ink);
  cairo_move_to(context_.get(), -share * width / PANGO_SCALE,
                -static_cast<double>(pango_layout_get_baseline(layout.get())) / PANGO_SCALE);
  pango_cairo_show_layout(context_.get(), layout.get());
  cairo_restore(context_.get());
}

}  // namespace ream::report
