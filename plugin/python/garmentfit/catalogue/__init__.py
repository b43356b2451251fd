# SPDX-License-Identifier: GPL-3.0-or-later
"""Dresses many bodies in many garments: one process of the command line for each pair, scheduled by Dask.

plan        which pairs, from TOML or CSV
store       the folder that holds all state
job         one process of the program, with limits
scheduling  the same job many times, on Dask workers
results     the table of all pairs
drawing     thumbnails and the meshes of the page's viewer
page        index.html
command     garmentfit catalogue
"""
