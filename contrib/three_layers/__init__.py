"""What contrib/three_layers.py runs, reads, compares with and draws."""
