"""What contrib/natural_crack.py runs, compares with and draws."""
