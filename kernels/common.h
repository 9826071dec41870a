// First include of every kernel file. a * b + c must be rounded twice, as the C++ twin rounds it.
#pragma OPENCL FP_CONTRACT OFF
