"""Writers of results, one file a format. A writer computes no physics."""
