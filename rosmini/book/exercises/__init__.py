"""What a right answer is: one module per chapter, `chapter_NN`, with the exercises of that notebook."""
