#include <nifti/nifti2_io.h>
#include <zlib.h>

#include <cstdlib>
#include <string_view>

constexpr int begin = 544;

/// Writes a NIfTI-2 file, its header by the reference library, whose names clash with those of the older one
/// in ITK, so that it needs a program of its own: 7 x 5 x 4 voxels of 16 bits, HU = 100 u + 10 v + w - 300.
int main(int count, char** arguments) {
  if (count != 2) return EXIT_FAILURE;
  const int64_t dims[8] = {3, 7, 5, 4, 1, 1, 1, 1};
  nifti_image* image = nifti_make_new_nim(dims, DT_INT16, 1);
  auto* value = static_cast<int16_t*>(image->data);
  for (int w = 0; w < 4; ++w)
    for (int v = 0; v < 5; ++v)
      for (int u = 0; u < 7; ++u) *value++ = static_cast<int16_t>(100 * u + 10 * v + w - 300);
  image->dx = image->pixdim[1] = 0.4;
  image->dy = image->pixdim[2] = 0.5;
  image->dz = image->pixdim[3] = 1.25;
  image->xyz_units = NIFTI_UNITS_MM;
  const double spacing[3] = {0.4, 0.5, 1.25};
  const double origin[3] = {12.5, -40.25, 300.125};
  // Turned by atan(3/4) about z.
  const double turn[3][3] = {{0.8, -0.6, 0}, {0.6, 0.8, 0}, {0, 0, 1}};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      image->sto_xyz.m[row][column] = turn[row][column] * spacing[column];
    image->sto_xyz.m[row][3] = origin[row];
  }
  image->sto_xyz.m[3][3] = 1;
  image->sform_code = NIFTI_XFORM_SCANNER_ANAT;
  image->nifti_type = NIFTI_FTYPE_NIFTI2_1;
  image->iname_offset = begin;
  nifti_2_header header;
  if (nifti_convert_nim2n2hdr(image, &header) != 0) return EXIT_FAILURE;
  const bool packed = std::string_view(arguments[1]).ends_with(".gz");
  const gzFile out = gzopen(arguments[1], packed ? "wb" : "wbT");
  const char no_extension[begin - sizeof header] = {};
  gzwrite(out, &header, sizeof header);
  gzwrite(out, no_extension, sizeof no_extension);
  gzwrite(out, image->data, 2 * 7 * 5 * 4);
  gzclose(out);
  nifti_image_free(image);
  return EXIT_SUCCESS;
}
