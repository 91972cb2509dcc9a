"""Random scenes whose answer is known by symmetry; contrib/campaign.py runs them."""
