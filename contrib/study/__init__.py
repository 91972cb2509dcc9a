"""Run a matrix of decks and report what each setting costs and how close it comes."""
