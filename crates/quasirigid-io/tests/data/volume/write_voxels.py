"""Writes voxels.tif with Pillow (pip install pillow==13.0.0 numpy): the labels of tests/volume_mesh/tiff.rs."""

import numpy as np
from PIL import Image

labels = np.array([0 if at % 10 == 3 else 1 + at // 7 % 3 for at in range(60)], np.uint16).reshape(3, 4, 5)
first, *others = [Image.fromarray(page) for page in labels]
# 317: the predictor, 2 for differences along a row
first.save("voxels.tif", save_all=True, append_images=others, compression="tiff_lzw", tiffinfo={317: 2})
