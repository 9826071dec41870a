"""What the module Ream does without a window. `client` and `_operations` beside this file are those of python/ream."""
